#!/bin/sh
# raster.sh FOLDER - small images to begin with: PFM of both byte orders, Radiance in all three ways of its texels
cd "$1" || exit 1
printf 'Pf\n2 1\n-1.0\n\0\0\200\077\0\0\200\177' > grey.pfm
printf 'PF 1 1 1 \077\200\0\0\100\0\0\0\177\300\0\0' > colour.pfm
radiance='#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n'
printf "$radiance"'-Y 1 +X 2\n\200\100\040\201\002\002\011\210' > flat.hdr
printf "$radiance"'-Y 1 +X 9\n\002\002\0\011\211\200\011\1\2\3\4\5\6\7\010\011\204\5\205\7\210\201\1\210' > scanlines.hdr
printf "$radiance"'-Y 1 +X 300\n\200\100\040\201\001\001\001\053\001\001\001\001' > old.hdr
