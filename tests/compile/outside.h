/* Included before all else: domain conditions that do not hold are told, and the test goes on. */
#ifndef OUTSIDE_H
#define OUTSIDE_H
void outside(const char *function);
#define LOBE_ASSERT(condition) ((condition) ? (void)0 : outside(__func__))
#endif
