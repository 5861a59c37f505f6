/* Steps a model for 10 s at 1 kHz and prints its coordinates as the firmware example does:
 *
 *     mbs export scenes/six-joint-arm.toml --binary arm.mbs
 *     cc example.c -I include libmbs_nostd_ffi.a -o example && ./example arm.mbs
 */
#include "mbs.h"

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* The model's bytes, as a controller has them in flash. */
static uint8_t model[1 << 16];

static int is_on(void *context)
{
    *(unsigned long *)context += 1;
    return 1;
}

static void write_line(char what, int step, const mbs_real *numbers, size_t n)
{
    printf("%c %d", what, step);
    for (size_t i = 0; i < n; i++) {
#ifdef MBS_SINGLE
        uint32_t bits;
#else
        uint64_t bits;
#endif
        memcpy(&bits, &numbers[i], sizeof bits);
        printf(" %" PRIx64, (uint64_t)bits);
    }
    printf("\n");
}

int main(int argc, char **argv)
{
    FILE *file = argc == 2 ? fopen(argv[1], "rb") : NULL;
    if (!file) {
        fprintf(stderr, "usage: example MODEL\n");
        return 2;
    }
    size_t n = fread(model, 1, sizeof model, file);
    fclose(file);

    /* A controller has a static array here; its size is mbs_size(). */
    size_t size = (mbs_size() + mbs_align() - 1) / mbs_align() * mbs_align();
    void *memory = aligned_alloc(mbs_align(), size);
    mbs_solver *solver;
    int status = mbs_init(memory, size, model, n, &solver);
    if (status != MBS_OK || mbs_init(memory, 8, model, n, &solver) != MBS_MEMORY
        || mbs_init(memory, size, model, 20, &solver) != MBS_MODEL) {
        fprintf(stderr, "mbs_init: %d\n", status);
        return 1;
    }
    unsigned long asked = 0;
    for (int step = 1; step <= 10000; step++) {
        mbs_report report;
        status = mbs_step(solver, (mbs_real)1e-3, is_on, &asked, &report);
        if (status != MBS_OK || report.is_cut_short) {
            fprintf(stderr, "step %d: %d\n", step, status);
            return 1;
        }
        if (step % 100 == 0) {
            mbs_real numbers[96];
            write_line('s', step, numbers, mbs_coordinates(solver, numbers, 96));
            write_line('v', step, numbers, mbs_velocities(solver, numbers, 96));
        }
    }
    free(memory);
    return 0;
}
