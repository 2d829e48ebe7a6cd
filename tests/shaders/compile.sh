#!/bin/sh
# Compiles every shader in both languages: sh compile.sh GLSL-FOLDER HLSL-FOLDER BUILD-FOLDER
#
# Leaves redirect.h for the C, and SPIR-V, validated, in BUILD-FOLDER/glsl and BUILD-FOLDER/hlsl. Checks on the way
# that the two folders say the same, and that the functions compile as OpenGL 4.5's and OpenGL ES 3.00's GLSL too.
set -eu
[ $# -eq 3 ] || { echo 'usage: compile.sh GLSL-FOLDER HLSL-FOLDER BUILD-FOLDER' >&2; exit 2; }
glsl=$1 hlsl=$2 build=$3
here=$(dirname "$0")
derive="sh $here/../../examples/shaders/hlsl.sh"
modules= headers=
for name in sg asg ggx_bound fis bilateral; do
    [ -e "$glsl/$name.glsl" ] || continue
    modules="$modules $glsl/$name.glsl" headers="$headers $name.h"
done
mkdir -p "$build/glsl" "$build/hlsl"

failed() {
    cat "$build/log" >&2
    echo "FAILED $1" >&2
    exit 1
}

# Twins do not drift apart.
for shader in "$glsl"/*; do
    twin=$hlsl/$(basename "$shader" .glsl).hlsl
    $derive "$shader" > "$build/twin" 2> "$build/log" || failed "$shader"
    cmp -s "$build/twin" "$twin" || { echo "FAILED $twin is not what $shader says: make hlsl" >&2; exit 1; }
done
for twin in "$hlsl"/*.hlsl; do
    name=$(basename "$twin" .hlsl)
    [ -e "$glsl/$name" ] || [ -e "$glsl/$name.glsl" ] || { echo "FAILED $twin has no twin in $glsl" >&2; exit 1; }
done
echo "ok     hlsl is glsl by the table of words"

# The functions, as a program of OpenGL's and of OpenGL ES's.
for version in '450 core' '300 es'; do
    {
        echo "#version $version"
        [ "$version" != '300 es' ] || printf 'precision highp float;\nprecision highp int;\n'
        cat $modules
        cat "$here/mips.glsl"
        echo 'void main() {}'
    } > "$build/functions.frag"
    glslangValidator "$build/functions.frag" > "$build/log" 2>&1 || failed "functions as GLSL $version"
    echo "ok     functions as GLSL $version"
done

# What the headers' tests ask.
made() {
    awk -v want="$1" -f "$here/calls.awk" $headers "$here/exempt.txt" $modules
}
made c > "$build/redirect.part" || exit 1
{
    echo '#ifndef REDIRECT_H'
    echo '#define REDIRECT_H'
    for header in $headers; do echo "#include \"$header\""; done
    echo '#include "tests/shaders/shader.h"'
    cat "$build/redirect.part"
    echo '#endif'
} > "$build/redirect.h"
{
    echo '#version 450'
    cat $modules "$here/texels.glsl" "$here/words.glsl"
    made glsl
} > "$build/glsl/calls.comp"
$derive "$build/glsl/calls.comp" > "$build/hlsl/calls.comp.hlsl" 2> "$build/log" || failed calls
$derive "$here/precision.comp" > "$build/hlsl/precision.comp.hlsl" 2> "$build/log" || failed precision

# SPIR-V.
compile() { # language, source, what it is to become, options...
    local language=$1 source=$2 to=$build/$1/$3.spv
    shift 3
    glslangValidator "$@" -V --target-env vulkan1.1 "$source" -o "$to" > "$build/log" 2>&1 || failed "$source"
    spirv-val --target-env vulkan1.1 "$to" > "$build/log" 2>&1 || failed "$source"
}
count=0
for shader in "$here/precision.comp" "$glsl"/*.comp "$glsl"/*.vert "$glsl"/*.frag; do
    [ -e "$shader" ] || continue
    name=$(basename "$shader") twins=$hlsl
    [ "$name" != precision.comp ] || twins=$build/hlsl
    compile glsl "$shader" "$name"
    compile hlsl "$twins/$name.hlsl" "$name" -D -e main -S "${name##*.}"
    count=$((count + 1))
done
# Without optimisation, so that both languages give the same operations: by default glslang fuses HLSL's a * b + c.
for function in $(sed -n 's/^#if FUNCTION == //p' "$build/glsl/calls.comp"); do
    compile glsl "$build/glsl/calls.comp" "calls.$function.comp" -DFUNCTION="$function"
    compile hlsl "$build/hlsl/calls.comp.hlsl" "calls.$function.comp" -DFUNCTION="$function" -Od -D -e main -S comp
    count=$((count + 1))
done
echo "ok     $count shaders as SPIR-V, from each language"
