/* Runs the self-checks of all.c (make_headers.cpp) here. Says which fail; exit status 1 if any does. */
#include <stdio.h>

#ifdef __cplusplus
extern "C" {
#endif
extern const unsigned glsum_verified_count;
unsigned glsum_verify(unsigned number);
#ifdef __cplusplus
}
#endif

int main(void)
{
    unsigned failed = 0U;
    unsigned number;
    for (number = 0U; number < glsum_verified_count; ++number) {
        const unsigned wrong = glsum_verify(number);
        if (wrong != 0U) {
            printf("g%u.h differs at sample %u\n", number, wrong);
            ++failed;
        }
    }
    printf("%u of %u headers have the kernel's bits\n", glsum_verified_count - failed, glsum_verified_count);
    return failed != 0U;
}
