#include "csv.h"
#include "fail.h"
#include "file.h"
#include "output.h"
#include <stdlib.h>
#include <string.h>

static void append(csv *table, const char *text) {
    const size_t length = strlen(text);
    if (table->length + length >= table->room) {
        char *more;
        table->room = 2 * table->room + length + 1024;
        more = (char *)realloc(table->text, table->room);
        if (!more) give_up("table", "not enough memory");
        table->text = more;
    }
    memcpy(table->text + table->length, text, length + 1);
    table->length += length;
}

csv csv_begin(const char *columns) {
    csv table = {NULL, 0, 0, 0};
    if (columns) {
        append(&table, columns);
        csv_row(&table);
    }
    return table;
}

static void append_field(csv *table, const char *text) {
    if (table->fields++) append(table, ",");
    append(table, text);
}

void csv_text(csv *table, const char *text) {
    size_t at = table->length;
    append_field(table, text);
    at += table->fields > 1;
    for (; at < table->length; at++) {
        if (table->text[at] == ',') table->text[at] = ';';
    }
}

void csv_count(csv *table, long count) {
    char text[32];
    snprintf(text, sizeof text, "%ld", count);
    append_field(table, text);
}

void csv_number(csv *table, double value) {
    char text[32];
    snprintf(text, sizeof text, "%.6g", value);
    append_field(table, text);
}

void csv_error(csv *table, double value) {
    char text[32];
    snprintf(text, sizeof text, "%.9g", value);
    append_field(table, text);
}

void csv_quartiles(csv *table, quartiles times) {
    csv_number(table, times.median);
    csv_number(table, times.low);
    csv_number(table, times.high);
}

void csv_skip(csv *table, int count) {
    while (count-- > 0) append_field(table, "");
}

void csv_row(csv *table) {
    append(table, "\n");
    table->fields = 0;
}

void csv_end(csv *table, const char *prefix, const char *rest, const char *what) {
    char path[OUTPUT_NAME];
    const char *wrong;
    file f;
    output_name(path, prefix, rest);
    wrong = file_begin(&f, path);
    if (!wrong) {
        fputs(table->text, f.stream);
        wrong = file_end(&f);
    }
    if (wrong) give_up(path, wrong);
    printf("wrote %s: %s\n", path, what);
    free(table->text);
}
