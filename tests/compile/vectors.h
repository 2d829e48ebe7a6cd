/* Vector types as others have them: VECTOR is C's plain struct, 1 a union as HandmadeMath's, 2 a wrapped float[3] for
   users of cglm, 3 a class as glm's. */
#if VECTOR == 1
typedef union union_vec3 {
    struct {
        float x, y, z;
    };
    struct {
        float r, g, b;
    };
    struct {
        float first;
        float rest[2];
    };
    float elements[3];
} user_vec3;
#elif VECTOR == 2
typedef float array_vec3[3]; /* has no fields, and a function cannot return it */
typedef union user_vec3 {
    array_vec3 raw; /* what the array's own functions take */
    struct {
        float x, y, z;
    };
} user_vec3;
#elif VECTOR == 3
namespace user {
struct vec3 {
    union {
        float x, r, s;
    };
    union {
        float y, g, t;
    };
    union {
        float z, b, p;
    };
    vec3() {
    }
    explicit vec3(float all) : x(all), y(all), z(all) {
    }
    vec3(float first, float second, float third) : x(first), y(second), z(third) {
    }
    template <typename A, typename B, typename C>
    vec3(A first, B second, C third) : x((float)first), y((float)second), z((float)third) {
    }
    float &operator[](int i) {
        return i == 0 ? x : i == 1 ? y : z;
    }
    vec3 &operator+=(const vec3 &v) {
        x += v.x, y += v.y, z += v.z;
        return *this;
    }
};
inline vec3 operator+(vec3 a, const vec3 &b) {
    return a += b;
}
inline vec3 operator*(const vec3 &a, float s) {
    return vec3(a.x * s, a.y * s, a.z * s);
}
} // namespace user
typedef user::vec3 user_vec3;
#else
typedef struct user_vec3 {
    float x, y, z;
} user_vec3;
#endif
#define LOBE_VEC3 user_vec3
