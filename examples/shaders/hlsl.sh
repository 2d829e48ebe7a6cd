#!/bin/sh
# Turns a shader of glsl/ into HLSL, by a table of words: sh hlsl.sh FILE.glsl > FILE.hlsl
#
# It knows the part of GLSL that glsl/ is written in, and refuses what means something else in HLSL.
set -eu
[ $# -eq 1 ] || { echo 'usage: hlsl.sh FILE' >&2; exit 2; }

if grep -nE '\b(mod|atan|fma|matrix|mat[234]|lessThan|greaterThan|equal|not)\(|\b[iu]?vec[234]\([^(),]*\)|[A-Za-z0-9_]\[\]\(|\b[a-z_0-9]+\[[0-9]+\]\(' "$1" |
    grep -v 'buffer' >&2; then
    echo "$1: these lines have no twin in HLSL by a table of words" >&2
    exit 1
fi

# What is built into GLSL are parameters of HLSL's main.
case $1 in
*.vert) parameters='uint vertex : SV_VertexID, out float4 position : SV_Position' ;;
*) parameters='uint3 workgroup : SV_GroupID, uint3 thread : SV_DispatchThreadID, uint3 local_thread : SV_GroupThreadID, uint local_index : SV_GroupIndex' ;;
esac

sed -E '
/^#version|^#extension|^precision |^    *memoryBarrierShared\(\);$/d
s/^#include "(.*)\.glsl"/#include "\1.hlsl"/

s/^layout\(constant_id = ([0-9]+)\) const /[[vk::constant_id(\1)]] const /
s/^layout\(std430, binding = ([0-9]+)\) readonly buffer [a-z_0-9]+ \{ ([a-z0-9]+) ([a-z_0-9]+)\[\]; \};/StructuredBuffer<\2> \3 : register(t\1);/
s/^layout\(std430, binding = ([0-9]+)\) buffer [a-z_0-9]+ \{ ([a-z0-9]+) ([a-z_0-9]+)\[\]; \};/RWStructuredBuffer<\2> \3 : register(u\1);/
s/^layout\(std140, binding = ([0-9]+)\) uniform ([a-z_0-9]+) \{/cbuffer \2 : register(b\1) {/
s/^layout\(location = 0\) out vec4 ([a-z_]+);/#define PIXEL \1/
s/^layout\(local_size_x = ([0-9]+)\) in;/[numthreads(\1, 1, 1)]/
s/^layout\(local_size_x = ([0-9]+), local_size_y = ([0-9]+)\) in;/[numthreads(\1, \2, 1)]/
s/^shared /groupshared /
s/^const (int|uint|float|vec[234]) /static const \1 /
s/barrier\(\);/GroupMemoryBarrierWithGroupSync();/
s/\b([a-z_0-9]+) = atomicAdd\(([^,]+), ([^,;]+)\);/InterlockedAdd(\2, \3, \1);/
s/\batomicAdd\(/InterlockedAdd(/

s/\bgl_GlobalInvocationID\b/thread/g
s/\bgl_LocalInvocationID\b/local_thread/g
s/\bgl_LocalInvocationIndex\b/local_index/g
s/\bgl_WorkGroupID\b/workgroup/g
s/\bgl_FragCoord\b/position/g
s/\bgl_VertexIndex\b/vertex/g
s/\bgl_Position\b/position/g

s/\bvec([234])\b/float\1/g
s/\bivec([234])\b/int\1/g
s/\buvec([234])\b/uint\1/g
s/\bbvec([234])\b/bool\1/g
s/\bmix\(/lerp(/g
s/\bfract\(/frac(/g
s/\binversesqrt\(/rsqrt(/g
s/\bfloatBitsToUint\(/asuint(/g
s/\bfloatBitsToInt\(/asint(/g
s/\b(uint|int)BitsToFloat\(/asfloat(/g
s/\bbitCount\(/countbits(/g
' "$1" | awk -v parameters="$parameters" '
/^#define PIXEL / { pixel = $3; next }
/^void main\(\) \{/ { $0 = pixel ? "void main(float4 position : SV_Position, out float4 " pixel " : SV_Target) {" : "void main(" parameters ") {" }
{ print }'
