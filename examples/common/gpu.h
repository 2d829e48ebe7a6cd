/*
 gpu.h - shaders on a Vulkan device: buffers, compute shaders, and fragment shaders over a whole picture

   gpu *device = gpu_open("");                                  // "llvmpipe" for Mesa's CPU driver
   buffers[0] = gpu_buffer_of(device, GPU_STORAGE, values, size); // bound as binding 0
   buffers[1] = gpu_buffer_create(device, GPU_STORAGE, size);
   program = gpu_compute_create(device, "build/shaders/glsl", "double", kinds, 2, 0);
   ms = gpu_run(program, buffers, groups, 1, 1);
   gpu_buffer_read(buffers[1], results);

 Whatever goes wrong ends the program with a message. Each create has its free; the device goes last.
*/
#ifndef GPU_H
#define GPU_H

#include <stddef.h>

typedef struct gpu gpu;
typedef struct gpu_buffer gpu_buffer;
typedef struct gpu_program gpu_program;

enum { GPU_MAX_BUFFERS = 8 };

typedef enum { GPU_STORAGE, GPU_UNIFORM } gpu_kind;
typedef enum { GPU_COMPUTE, GPU_FRAGMENT } gpu_stage;

/* The first device whose name contains the text, a real GPU before a CPU driver. */
gpu *gpu_open(const char *name);
const char *gpu_name(const gpu *device);
void gpu_close(gpu *device);

gpu_buffer *gpu_buffer_create(gpu *device, gpu_kind kind, size_t size);
gpu_buffer *gpu_buffer_of(gpu *device, gpu_kind kind, const void *values, size_t size);
void gpu_buffer_write(gpu_buffer *b, const void *values); /* all of its bytes */
void gpu_buffer_read(gpu_buffer *b, void *values);
void gpu_buffer_free(gpu_buffer *b);

/* A compute shader, NAME.comp.spv in a folder, whose buffers have bindings 0, 1, ... The constant is that of
   constant_id 0. */
gpu_program *gpu_compute_create(gpu *device, const char *folder, const char *name, const gpu_kind *kinds, int count,
                                int constant);

/* A fragment shader, NAME.frag.spv, over a picture of four floats a pixel that fullscreen.vert.spv covers. */
gpu_program *gpu_fragment_create(gpu *device, const char *folder, const char *name, const gpu_kind *kinds, int count);
void gpu_program_free(gpu_program *p);

/* Both return the milliseconds that the device took. A run is over when they return. */
double gpu_run(gpu_program *p, gpu_buffer *const *buffers, int groups_x, int groups_y, int groups_z);
double gpu_draw(gpu_program *p, gpu_buffer *const *buffers, int width, int height, float *pixels);

#endif
