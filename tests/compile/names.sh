#!/bin/sh
# Names: ours have our prefixes, are nobody else's, and shaders can have the parameters'. usage: names.sh FOLDER
folder=$1/names
mkdir -p "$folder" || exit 1
. tests/compile/step.sh

names() { # folder of headers
    awk -f tests/compile/names.awk "$1"/*.h | awk '
        BEGIN {
            while ((getline line < "tests/compile/foreign_names.txt") > 0) if (line !~ /^#/) { foreign[line] = 1; owned++ }
            count = split("active asm buffer cast common discard filter flat half input line linear matrix output partition " \
                          "patch point precise resource sample sampler shared smooth superp texture triangle vector fixed " \
                          "in inout out uniform varying attribute centroid noperspective lowp mediump highp precision " \
                          "texture2D register packoffset string technique pass sampler2D export compile interface " \
                          "namespace template this using union unsigned goto class public extern external long short " \
                          "double volatile groupshared row_major column_major snorm unorm", words)
            for (i = 1; i <= count; i++) shader[words[i]] = 1
        }
        { total++ }
        # of the C library and of compilers
        $2 ~ /^(sqrtf|__attribute__|__THROW|C)$/ { next }
        $1 == "parameter" {
            if ($2 in shader) { print $3 ": a word of shaders: " $2; bad = 1 }
            if ($2 ~ /[A-Z]/) { print $3 ": a parameter with capitals: " $2; bad = 1 }
            next
        }
        $2 in foreign { print $3 ": taken: " $2; bad = 1 }
        $1 == "macro" && $2 !~ /^LOBE_/ { print $3 ": a macro without LOBE_: " $2; bad = 1 }
        $1 == "name" && $2 !~ /^(lobe|sg|vsgl|vsl|asg|ggx|fis|bilateral)(_|$)/ && $2 !~ /^(LOBE|VSGL|ASG)_/ {
            print $3 ": without a prefix of ours: " $2
            bad = 1
        }
        END { if (total < 500 || owned < 1500) { print "only " total + 0 " names, " owned + 0 " of others"; bad = 1 }
              exit bad }'
}

# What it must find, put at the end of one header.
found() { # text, what it must say
    rm -rf "$folder/changed" && mkdir "$folder/changed" && cp sg.h asg.h fis.h ggx_bound.h bilateral.h "$folder/changed" &&
        printf '%s\n' "$1" >> "$folder/changed/asg.h" && fails "$2" names "$folder/changed"
}
found_all() {
    found 'LOBE_API int sg_make_buffer(void) {' 'taken: sg_make_buffer' &&
        found 'struct sg_io_hdr { int x; };' 'taken: sg_io_hdr' &&
        found 'enum { LOBE_ONE, SG_ALICE_BLUE };' 'taken: SG_ALICE_BLUE' &&
        found 'LOBE_API float mix(float x);' 'without a prefix of ours: mix' &&
        found '#define SG_PI 3' 'a macro without LOBE_: SG_PI' &&
        found 'LOBE_API float sg_x(const float *half, int N);' 'a word of shaders: half' &&
        found 'LOBE_API float sg_x(const float *wide, int N);' 'capitals: N'
}

step 'names at file scope' names .
step 'names, refused' found_all
exit 0
