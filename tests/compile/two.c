/* Two translation units of values.c in one program: their values one after the other. */
#ifdef __cplusplus
extern "C" {
#endif
void first_values(void);
void second_values(void);
#ifdef __cplusplus
}
#endif

int main(void) {
    first_values();
    second_values();
    return 0;
}
