/* Macros that other headers leave behind. windows.h: */
#define near
#define far
#define NEAR near
#define FAR far
#define min(a, b) (((a) < (b)) ? (a) : (b))
#define max(a, b) (((a) > (b)) ? (a) : (b))
#define small char
#define hyper __int64
#define interface struct
#define pascal __stdcall
#define cdecl __cdecl
#define IN
#define OUT
#define OPTIONAL
#define CONST const
#define ERROR 0
#define DIFFERENCE 11
#define DrawText DrawTextW
#define GetObject GetObjectW
#define CreateFont CreateFontW
/* X.h and Xlib.h: */
#define None 0L
#define True 1
#define False 0
#define Bool int
#define Status int
#define Success 0
#define Always 2
#define Above 0
#define Below 1
#define Complex 0
/* math.h with its extensions, complex.h, and programs of one page: */
#define M_PI 3.14159265358979323846
#define PI 3.14159265f
#define TWO_PI (2 * PI)
#define EPSILON 1e-6f
#define I (__extension__ 1.0iF)
#define N 16
#define E 2.71828f
#define sqr(x) ((x) * (x))
#define lerp(a, b, t) ((a) + (t) * ((b) - (a)))
#define clamp(x, low, high) min(max(x, low), high)
#define saturate(x) clamp(x, 0, 1)
#define abs(x) ((x) < 0 ? -(x) : (x))
#define dot(a, b) ((a).x * (b).x + (a).y * (b).y + (a).z * (b).z)
#define cross(a, b) bad
#define length(v) bad
#define normalize(v) bad
#define vec3 bad
#define float3 bad
