/* Runs the headers' unit tests on the shaders, in each language. */
#include "../../examples/common/fail.h"
#include "../../examples/common/gpu.h"
#include "../test.h"
#include "precision.h"
#include "shader.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

const char *const program_name = "shader_tests";

enum { MOST_WORDS = 256, MOST_QUESTIONS = 1 << 20, MOST_ROUNDS = 5, ENOUGH = 100000, MOST_SEEDS = 100 };

typedef struct {
    const char *name;
    int in_words, out_words;
    int count, answered, room; /* questions of the running test */
    unsigned *in, *out;
    int *slots, slot_count;   /* hash table of question + 1 */
    int next;                 /* question expected: a test mostly asks in the order in which it did */
    int asked;                /* by this test */
    long total;               /* answered in all tests */
    long judged;              /* and in those that judge accuracy, not only whether results are finite */
    gpu_program *programs[2]; /* in each language */
} function;

static function functions[SHADER_FUNCTIONS];
static gpu *device;
static const char *const languages[2] = {"glsl", "hlsl"};
static const char *folder;   /* of both languages' folders */
static int language;         /* whose answers the tests get */
static int judges_accuracy;  /* the running test: not whether results are finite alone */
static int languages_differ; /* in any answer to this test */
static long calls;           /* in this run of the test */
static long unanswered;      /* and those for which the header's result stood */

/* ---- one call ---- */

static struct {
    function *f;
    unsigned words[MOST_WORDS];
    int word_count, result_at;
    const unsigned *answer; /* null: the header's result stands */
    int unfit;
} call;

void shader_begin(int which, const char *name, int in_words, int out_words) {
    call.f = &functions[which];
    call.f->name = name;
    call.f->in_words = in_words;
    call.f->out_words = out_words;
    call.word_count = call.result_at = call.unfit = 0;
    call.answer = NULL;
}

void shader_in(const void *argument, size_t size) {
    int words = (int)(size / sizeof *call.words);
    if (call.word_count + words > MOST_WORDS) give_up(call.f->name, "too many words");
    memcpy(call.words + call.word_count, argument, size);
    call.word_count += words;
}

void shader_in_some(const void *elements, size_t size, int count, int most) {
    static const unsigned zero[MOST_WORDS];
    if (count > most) {
        call.unfit = 1;
        return;
    }
    shader_in(elements, size * (size_t)count);
    shader_in(zero, size * (size_t)(most - count));
}

static unsigned hash_of(const unsigned *words, int count) {
    unsigned hash = 2166136261u;
    int i;
    for (i = 0; i < count; i++) {
        hash = (hash ^ words[i]) * 16777619u;
        hash ^= hash >> 15;
    }
    return hash;
}

static int is_question(const function *f, int question, const unsigned *words) {
    size_t count = (size_t)f->in_words;
    return !memcmp(f->in + (size_t)question * count, words, count * sizeof *words);
}

static int *slot_of(function *f, const unsigned *words) {
    unsigned mask = (unsigned)f->slot_count - 1, at = hash_of(words, f->in_words) & mask;
    while (f->slots[at] && !is_question(f, f->slots[at] - 1, words)) at = (at + 1) & mask;
    return &f->slots[at];
}

static void *grown(void *memory, size_t count, size_t size) {
    memory = realloc(memory, count * size);
    if (!memory) give_up("questions", "not enough memory");
    return memory;
}

static void make_room(function *f) {
    int i;
    f->room = f->room ? 2 * f->room : 1024;
    f->in = grown(f->in, (size_t)f->room * (size_t)f->in_words, sizeof *f->in);
    f->out = grown(f->out, (size_t)f->room * (size_t)f->out_words, sizeof *f->out);
    f->slot_count = 2 * f->room;
    f->slots = grown(f->slots, (size_t)f->slot_count, sizeof *f->slots);
    memset(f->slots, 0, (size_t)f->slot_count * sizeof *f->slots);
    for (i = 0; i < f->count; i++) *slot_of(f, f->in + (size_t)i * (size_t)f->in_words) = i + 1;
}

void shader_find(void) {
    function *f = call.f;
    int question;
    calls++;
    unanswered++;
    if (call.unfit) return;
    if (call.word_count != f->in_words) give_up(f->name, "takes other words in the shader than in the header");
    f->asked = 1;
    question = f->next;
    if (question >= f->count || !is_question(f, question, call.words)) {
        int *slot;
        if (f->count >= f->room) make_room(f);
        slot = slot_of(f, call.words);
        if (!*slot) {
            if (f->count >= MOST_QUESTIONS) return;
            memcpy(f->in + (size_t)f->count * (size_t)f->in_words, call.words,
                   (size_t)f->in_words * sizeof *call.words);
            *slot = ++f->count;
        }
        question = *slot - 1;
    }
    f->next = question + 1;
    if (question < f->answered) {
        call.answer = f->out + (size_t)question * (size_t)f->out_words;
        unanswered--;
    }
}

/* ---- texels of pyramids ---- */

enum { MOST_TEXELS = 1 << 26, MOST_PYRAMIDS = 1 << 13, RECENT = 8 };

typedef struct {
    unsigned hash;
    int first, size; /* floats of the pool */
} content;

static struct {
    unsigned *texels; /* floats' bits */
    int size, room;
    content contents[MOST_PYRAMIDS];
    int count;
    struct {
        const float *texels;
        int planes, first;
    } recent[RECENT]; /* where pyramids are that have not been built anew since */
    int next;
} pool;

void shader_renew(void) {
    memset(pool.recent, 0, sizeof pool.recent);
}

/* Its floats, at the pool's end: as they are, or by planes of four channels */
static int append(const fis_pyramid *p, int planes) {
    const int count = p->offset[p->levels - 1] + 1, groups = planes ? (p->channels + 3) / 4 : 1, width = planes ? 4 : 1;
    const int size = count * groups * width;
    int group, i, c;
    if (size > MOST_TEXELS - pool.size) return 0;
    if (pool.room < pool.size + size) {
        pool.room = 2 * (pool.size + size);
        pool.texels = grown(pool.texels, (size_t)pool.room, sizeof *pool.texels);
    }
    for (group = 0; group < groups; group++) {
        for (i = 0; i < count; i++) {
            for (c = 0; c < width; c++) {
                const int channel = width * group + c;
                const float *texel = p->texels + (size_t)i * (size_t)p->channels + channel;
                unsigned *to = &pool.texels[pool.size + (group * count + i) * width + c];
                *to = 0;
                if (channel < p->channels) memcpy(to, texel, sizeof *to);
            }
        }
    }
    return size;
}

/* Where they are in the pool from now on, or -1 if it is full */
static int find_content(const fis_pyramid *p, int planes) {
    const int size = append(p, planes);
    content *c = pool.contents;
    unsigned hash;
    if (!size || pool.count == MOST_PYRAMIDS) return -1;
    hash = hash_of(pool.texels + pool.size, size);
    for (; c < pool.contents + pool.count; c++)
        if (c->hash == hash && c->size == size &&
            !memcmp(pool.texels + c->first, pool.texels + pool.size, (size_t)size * sizeof *pool.texels))
            return c->first;
    c->hash = hash;
    c->first = pool.size;
    c->size = size;
    pool.count++;
    pool.size += size;
    return c->first;
}

static void take_pyramid(const fis_pyramid *p, int planes) {
    int words[4], i;
    for (i = 0; i < RECENT; i++)
        if (pool.recent[i].texels == p->texels && pool.recent[i].planes == planes) break;
    if (i == RECENT) {
        i = pool.next;
        pool.next = (pool.next + 1) % RECENT;
        pool.recent[i].texels = p->texels;
        pool.recent[i].planes = planes;
        pool.recent[i].first = find_content(p, planes);
    }
    words[0] = p->width;
    words[1] = p->height;
    words[2] = p->levels;
    words[3] = pool.recent[i].first;
    if (words[3] < 0) call.unfit = 1;
    shader_in(words, sizeof words);
}

void shader_in_pyramid(const fis_pyramid *pdf) {
    take_pyramid(pdf, 0);
}

void shader_in_planes(const fis_pyramid *pyramid) {
    take_pyramid(pyramid, 1);
}

/* ---- answers ---- */

static int is_finite(unsigned word) {
    return (word & 0x7F800000u) != 0x7F800000u;
}

void shader_out(void *result, size_t size) {
    int words = (int)(size / sizeof *call.answer), i;
    unsigned ours[MOST_WORDS];
    if (!call.answer) return;
    if (call.result_at + words > call.f->out_words) give_up(call.f->name, "returns other words in the shader");
    memcpy(ours, result, size);
    memcpy(result, call.answer + call.result_at, size);
    for (i = 0; i < words; i++) {
        if (is_finite(ours[i]) && !is_finite(call.answer[call.result_at + i])) {
            double input[MOST_WORDS];
            int k;
            for (k = 0; k < call.word_count; k++) {
                float x;
                memcpy(&x, &call.words[k], sizeof x);
                input[k] = (double)x;
            }
            test_that(0, call.f->name, input, call.word_count);
        }
    }
    call.result_at += words;
}

void shader_out_some(void *elements, size_t size, int count, int most) {
    shader_out(elements, size * (size_t)count);
    call.result_at += (int)size / (int)sizeof *call.answer * (most - count);
}

/* ---- all questions ---- */

static void forget(void) {
    int i;
    pool.size = pool.count = 0;
    shader_renew();
    for (i = 0; i < SHADER_FUNCTIONS; i++) {
        functions[i].count = functions[i].answered = functions[i].asked = functions[i].next = 0;
        if (functions[i].slots)
            memset(functions[i].slots, 0, (size_t)functions[i].slot_count * sizeof *functions[i].slots);
    }
}

/* The answers in one language */
static void ask_in(function *f, int which, int in, const unsigned *questions, unsigned *answers, int groups) {
    static const gpu_kind kinds[3] = {GPU_STORAGE, GPU_STORAGE, GPU_STORAGE};
    static const unsigned none = 0;
    gpu_buffer *buffers[3];
    int i;
    if (!f->programs[in]) {
        char path[1024], name[32];
        snprintf(path, sizeof path, "%s/%s", folder, languages[in]);
        snprintf(name, sizeof name, "calls.%d", which);
        f->programs[in] = gpu_compute_create(device, path, name, kinds, 3, 0);
    }
    buffers[0] =
        gpu_buffer_of(device, GPU_STORAGE, questions, (size_t)groups * 64 * (size_t)f->in_words * sizeof *questions);
    buffers[1] = gpu_buffer_create(device, GPU_STORAGE, (size_t)groups * 64 * (size_t)f->out_words * sizeof *answers);
    if (pool.size)
        buffers[2] = gpu_buffer_of(device, GPU_STORAGE, pool.texels, (size_t)pool.size * sizeof *pool.texels);
    else
        buffers[2] = gpu_buffer_of(device, GPU_STORAGE, &none, sizeof none);
    gpu_run(f->programs[in], buffers, groups, 1, 1);
    gpu_buffer_read(buffers[1], answers);
    for (i = 0; i < 3; i++) gpu_buffer_free(buffers[i]);
}

/* In both languages at once, since they mostly agree to the bit */
static void ask(function *f, int which) {
    int count = f->count - f->answered, groups = (count + 63) / 64, in;
    size_t in_words = (size_t)f->in_words, out_words = (size_t)f->out_words;
    size_t size = (size_t)count * out_words * sizeof *f->out;
    unsigned *questions = allocate("questions", (size_t)groups * 64 * in_words, sizeof *questions), *answers[2];
    memcpy(questions, f->in + (size_t)f->answered * in_words, (size_t)count * in_words * sizeof *questions);
    for (in = 0; in < 2; in++) {
        answers[in] = allocate("answers", (size_t)groups * 64 * out_words, sizeof *answers[in]);
        ask_in(f, which, in, questions, answers[in], groups);
    }
    languages_differ |= memcmp(answers[0], answers[1], size) != 0;
    memcpy(f->out + (size_t)f->answered * out_words, answers[language], size);
    free(questions);
    free(answers[0]);
    free(answers[1]);
    if (!language) f->total += count;
    if (!language && judges_accuracy) f->judged += count;
    f->answered = f->count;
}

/* Returns how many were new, and tells whether those were few. */
static int ask_all(int *few) {
    int i, news = 0, count = 0;
    for (i = 0; i < SHADER_FUNCTIONS; i++) {
        count += functions[i].count;
        functions[i].next = 0;
        news += functions[i].count - functions[i].answered;
        if (functions[i].count > functions[i].answered) ask(&functions[i], i);
    }
    *few = news <= count / 32;
    return news;
}

/* ---- tests ---- */

typedef struct {
    const char *test, *why;
} exception;

/* What a test asks that no shader promises */
static const exception exceptions[] = {{"fis_integral", "pyramids that fis_build made, which is no shader's"},
                                       {"fis_quality", "counts the texels that are read"},
                                       {NULL, NULL}};

static const char *exception_of(const char *test) {
    int i;
    for (i = 0; exceptions[i].test; i++)
        if (!strcmp(test, exceptions[i].test)) return exceptions[i].why;
    return NULL;
}

/* Whether the test asked for a function of which not enough has been asked, in all tests */
static int is_wanted(const char *asks) {
    int i;
    for (i = 0; i < SHADER_FUNCTIONS; i++)
        if (asks[i] && functions[i].total < ENOUGH) return 1;
    return 0;
}

static int is_about_shaders(void) {
    int i;
    for (i = 0; i < SHADER_FUNCTIONS; i++)
        if (functions[i].asked) return 1;
    return 0;
}

/* Runs a test on the answers in one language: -1 where it is not about shaders, else how many checks failed */
static int judge_in(const test_case *test, int in) {
    int round, failures = 0, news = 1, few = 0;
    language = in;
    forget();
    test_quiet = 1;
    for (round = 0; round < MOST_ROUNDS && !few; round++) { /* what a search asks depends on all answers before */
        calls = unanswered = 0;
        failures = test_run(test);
        news = ask_all(&few);
    }
    if (!is_about_shaders()) return -1;
    if (!news && !failures && !test_verbose) {
        if (!test_seed) printf("ok     %s\n", test->name);
        return 0;
    }
    test_quiet = test_seed != 0; /* more of the same */
    calls = unanswered = 0;
    failures = test_run(test);
    if (test_verbose && !test_quiet) printf("    %ld of %ld calls answered by the shader\n", calls - unanswered, calls);
    return failures;
}

static int judge(const test_case *test) {
    int failures, others;
    languages_differ = 0;
    judges_accuracy = !strstr(test->name, "finite");
    failures = judge_in(test, 0);
    if (failures < 0 || !languages_differ) return failures;
    if (!test_seed) printf("    and in HLSL, where not all answers are the same to the bit:\n");
    others = judge_in(test, 1);
    return failures + (others > 0 ? others : 0);
}

static void judge_all(const char *wanted, int *passed, int *failed) {
    static char asks[1024][SHADER_FUNCTIONS]; /* of each test */
    int table, at, failures, seed, repeated = 1, i;
    for (seed = 0; repeated && seed < (*wanted ? 1 : MOST_SEEDS); seed++) { /* counts are for all tests alone */
        repeated = 0;
        test_seed = (unsigned long long)seed << 32;
        for (table = at = 0; test_tables[table]; table++) {
            const test_case *test;
            for (test = test_tables[table]; test->name; test++, at++) {
                if (!strstr(test->name, wanted) || exception_of(test->name)) continue;
                if (seed && !is_wanted(asks[at])) continue;
                failures = judge(test);
                if (failures < 0) continue;
                for (i = 0; i < SHADER_FUNCTIONS; i++) asks[at][i] = (char)functions[i].asked;
                repeated = 1;
                if (seed && failures) printf("FAILED %s, seed %d\n", test->name, seed);
                if (!seed && !failures) ++*passed;
                if (failures) ++*failed;
            }
        }
    }
}

static void judge_counts(int *passed, int *failed) {
    int i;
    for (i = 0; i < SHADER_FUNCTIONS; i++) {
        const function *f = &functions[i];
        if (test_verbose || f->total < ENOUGH)
            printf("%s %s: %ld inputs, %ld of them judged for accuracy\n", f->total < ENOUGH ? "FAILED" : "ok    ",
                   f->name ? f->name : "a function", f->total, f->judged);
        if (f->total < ENOUGH)
            ++*failed;
        else
            ++*passed;
    }
}

static void end(void) {
    int i, in;
    for (i = 0; i < SHADER_FUNCTIONS; i++) {
        for (in = 0; in < 2; in++)
            if (functions[i].programs[in]) gpu_program_free(functions[i].programs[in]);
        free(functions[i].in);
        free(functions[i].out);
        free(functions[i].slots);
    }
    free(pool.texels);
    gpu_close(device);
}

static void usage(FILE *to) {
    fprintf(to, "usage: shader_tests [--verbose] [--device NAME] [--root DIR] FOLDER [TEST]\n"
                "  FOLDER     where glsl/ and hlsl/ with the shaders in SPIR-V are\n"
                "  TEST       run only the tests whose name contains it\n"
                "  --device   a Vulkan device whose name contains it (default: a GPU, or else a CPU's driver)\n"
                "  --verbose  print the largest error seen beside each bound\n"
                "  --root     where the headers are (default: .)\n");
}

int main(int argc, char **argv) {
    const char *wanted = NULL, *name = "";
    int passed = 0, failed = 0, i;
    test_files = argv[0];
    test_least = test_most = ENOUGH + ENOUGH / 20; /* some draws are alike */
    for (i = 1; i < argc; i++) {
        if (!strcmp(argv[i], "--help")) {
            usage(stdout);
            return 0;
        } else if (!strcmp(argv[i], "--verbose")) {
            test_verbose = 1;
        } else if (!strcmp(argv[i], "--root") && i + 1 < argc) {
            test_root = argv[++i];
        } else if (!strcmp(argv[i], "--device") && i + 1 < argc) {
            name = argv[++i];
        } else if (argv[i][0] == '-' || wanted) {
            usage(stderr);
            return 2;
        } else if (folder) {
            wanted = argv[i];
        } else {
            folder = argv[i];
        }
    }
    if (!folder) {
        usage(stderr);
        return 2;
    }
    device = gpu_open(name);
    printf("%s\n", gpu_name(device));
    /* Errors are sums of those of operations, and a device has larger ones only in its own functions: at most that many
       times. The 4 are for other orders of operations. */
    test_slack = fmax(4, precision_measure(device, folder, &failed));
    judge_all(wanted ? wanted : "", &passed, &failed);
    if (!wanted) judge_counts(&passed, &failed);
    end();
    if (passed + failed == 0) {
        fprintf(stderr, "shader_tests: no test about shaders has a name that contains '%s'\n", wanted ? wanted : "");
        return 2;
    }
    printf("%d passed, %d failed\n", passed, failed);
    return failed != 0;
}
