/* Runs the pipelines' shaders in each language, and compares their pictures with those of the CPU. */
#include "pipelines.h"
#include "../../../examples/common/fail.h"
#include <stdio.h>
#include <string.h>

const char *const program_name = "pipeline_tests";

static int passed, failed;

void pipeline_check(const char *what, int holds) {
    printf("%s %s\n", holds ? "ok    " : "FAILED", what);
    fflush(stdout);
    if (holds)
        passed++;
    else
        failed++;
}

static double brightest(const image *picture) {
    double most = 0;
    int i;
    for (i = 0; i < picture->width * picture->height; i++) most = fmax(most, (double)lobe_mean(picture->pixels[i]));
    return most;
}

void pipeline_picture(const char *what, const image *got, const image *wanted, float exposure) {
    double psnr = image_psnr(got, wanted, exposure), most = brightest(wanted);
    char line[256];
    snprintf(line, sizeof line, "%s: PSNR %.1f dB, mean error %.2g of the mean", what, psnr,
             image_relative_error(got, wanted));
    pipeline_check(line, psnr >= 60 && most > 0 && fabs(brightest(got) / most - 1) < 0.01);
}

typedef struct {
    const char *name;
    void (*run)(gpu *device, const char *folder);
} pipeline;

static const pipeline pipelines[] = {
    {"generate", pipeline_generate}, {"shade", pipeline_shade}, {"cull", pipeline_cull}, {"filter", pipeline_filter}};

static void usage(FILE *to) {
    fprintf(to, "usage: pipeline_tests [--device NAME] FOLDER [PIPELINE]\n"
                "  FOLDER    where glsl/ and hlsl/ with the shaders in SPIR-V are\n"
                "  PIPELINE  run only those whose name contains it\n"
                "  --device  a Vulkan device whose name contains it (default: a GPU, or else a CPU's driver)\n");
}

int main(int argc, char **argv) {
    static const char *const languages[] = {"glsl", "hlsl"};
    const char *folder = NULL, *wanted = NULL, *name = "";
    gpu *device;
    size_t k;
    int i;
    for (i = 1; i < argc; i++) {
        if (!strcmp(argv[i], "--help")) {
            usage(stdout);
            return 0;
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
    for (i = 0; i < 2; i++) {
        char path[1024];
        snprintf(path, sizeof path, "%s/%s", folder, languages[i]);
        printf("%s\n", languages[i]);
        for (k = 0; k < sizeof pipelines / sizeof *pipelines; k++)
            if (!wanted || strstr(pipelines[k].name, wanted)) pipelines[k].run(device, path);
    }
    gpu_close(device);
    if (passed + failed == 0) {
        fprintf(stderr, "pipeline_tests: no pipeline's name contains '%s'\n", wanted ? wanted : "");
        return 2;
    }
    printf("%d passed, %d failed\n", passed, failed);
    return failed != 0;
}
