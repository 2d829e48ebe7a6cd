/* parallel.h - a loop over threads where the compiler has OpenMP, a plain loop where not. */
#ifndef PARALLEL_H
#define PARALLEL_H

#ifdef _OPENMP
#define PARALLEL_FOR _Pragma("omp parallel for schedule(dynamic, 1)")
#else
#define PARALLEL_FOR
#endif

#endif
