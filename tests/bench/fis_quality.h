/* fis_quality.h - what is not timed of fis.h's kernels: computed apart, where the texels that are read are counted */
#ifndef FIS_QUALITY_H
#define FIS_QUALITY_H

enum { FIS_SIDE = 512, FIS_KERNELS = 1024, FIS_METHODS = 5 };

typedef struct {
    const char *method;
    double reads;          /* texels a kernel */
    double rms, largest;   /* errors of the levels; below 0 where there are none */
    double gap, overlap;   /* parts of the PDF's mass */
    double firefly, total; /* the brightest kernel over the mean, all over the image's total, of an unlike image */
} fis_quality;

/* A PDF of FIS_SIDE by FIS_SIDE, the caller's to free, and its name; none where there are no more kinds */
float *fis_quality_image(int kind, const char **name);

/* How good the kernels of each method are on that PDF */
void fis_quality_of(int kind, fis_quality rows[FIS_METHODS]);

/* Standard deviation over mean of the light that receivers get, by each method, when the PDF's noise is fresh each frame */
void fis_quality_flicker(double flicker[FIS_METHODS]);

#endif
