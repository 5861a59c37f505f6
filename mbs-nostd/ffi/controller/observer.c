/* An observer of a two-link arm, and a loop that is closed, on an emulated Cortex-M7: what firmware/src/bin/observer.rs does in Rust,
 * which derives the gains, with the same lines and bits.
 *
 *     clang --target=thumbv7em-none-eabihf -mcpu=cortex-m7 -ffreestanding -ffp-contract=off -O1 -I include -I MODELS -c controller/observer.c
 *     ld.lld -T controller/controller.ld observer.o libmbs_nostd_ffi.a -o observer
 *     qemu-system-arm -machine mps2-an500 -cpu cortex-m7 -nographic -semihosting-config enable=on,target=native -kernel observer
 *
 * MODELS is the folder of `models.h`, whose arrays `arm_model` and `linkage_model` have the bytes of `mbs export --binary`. */
#include "mbs.h"
#include "models.h"

/* Step of the arm, of the observer and of the linkage [s]. */
#define STEP 1e-3
/* Steps of the run, and those between two that are reported. */
#define STEPS 500
#define REPORT_INTERVAL 50
/* Torque of the shoulder's motor, which arm and observer are given [N m]. */
#define TORQUE 0.5
/* Double root of the observer's error [1/s]. */
#define ROOT 20.0
/* Bytes for a solver: more than mbs_size() of the library in double precision. */
#define MEMORY (384 * 1024)

static _Alignas(16) uint8_t memory[3][MEMORY];

/* Errors of the observer's angles at the start [rad]. */
static const mbs_real start_errors[2] = {0.04, 0.02};
/* What the coordinates and the velocities of the loop are put aside by [rad, rad/s]. */
static const mbs_real aside[3] = {0.05, -0.025, 0.0125};

/* ---- the board: start, output and end by semihosting ---- */

int main(void);
void reset(void);
extern uint32_t stack_top, bss_begin, bss_end;

/* Standard output, as the debugger has opened it. */
static uint32_t out;

static uint32_t semihost(uint32_t operation, const void *argument)
{
    register uint32_t r0 __asm__("r0") = operation;
    register const void *r1 __asm__("r1") = argument;
    __asm__ volatile("bkpt 0xab" : "+r"(r0) : "r"(r1) : "memory");
    return r0;
}

static void end(int status)
{
    /* ADP_Stopped_ApplicationExit, or ADP_Stopped_RunTimeError */
    semihost(0x18, (const void *)(status == 0 ? 0x20026 : 0x20023));
    for (;;) {
    }
}

static void fault(void)
{
    end(1);
}

__attribute__((noinline)) static void start(void)
{
    /* SYS_OPEN of the console for writing: SYS_WRITE0 would write to the emulator's standard error */
    static const struct {
        const char *name;
        uint32_t mode, length;
    } console = {":tt", 4, 3};
    out = semihost(0x01, &console);
    end(main());
}

void reset(void)
{
    /* access to the floating-point unit, before the first instruction of it */
    *(volatile uint32_t *)0xe000ed88 |= 0xfu << 20;
    __asm__ volatile("dsb\n\tisb" ::: "memory");
    for (volatile uint32_t *word = &bss_begin; word < &bss_end; word++) {
        *word = 0;
    }
    start();
}

typedef void (*handler)(void);
__attribute__((section(".vectors"), used)) static const handler vectors[16] = {
    (handler)&stack_top, reset, fault, fault, fault, fault, fault,
};

/* Writes a letter, a step where there is one, and numbers as bits. */
static void write_line(char what, int step, const mbs_real *numbers, int n)
{
    char line[96];
    int at = 0;
    line[at++] = what;
    if (step > 0) {
        line[at++] = ' ';
        for (int power = 100; power > 0; power /= 10) {
            if (step >= power) {
                line[at++] = (char)('0' + step / power % 10);
            }
        }
    }
    for (int i = 0; i < n; i++) {
        union {
            double number;
            uint64_t bits;
        } x = {.number = numbers[i]};
        int shift = 60;
        while (shift > 0 && x.bits >> shift == 0) {
            shift -= 4;
        }
        line[at++] = ' ';
        for (; shift >= 0; shift -= 4) {
            line[at++] = "0123456789abcdef"[x.bits >> shift & 15];
        }
    }
    line[at++] = '\n';
    const uint32_t text[3] = {out, (uint32_t)line, (uint32_t)at};
    semihost(0x05, text);
}

/* ---- the observer ---- */

/* -x y of two matrices. */
static void minus_product(const mbs_real x[2][2], const mbs_real y[2][2], mbs_real product[2][2])
{
    for (int i = 0; i < 2; i++) {
        for (int j = 0; j < 2; j++) {
            product[i][j] = -(x[i][0] * y[0][j] + x[i][1] * y[1][j]);
        }
    }
}

/* h L1 and h L2, L1 = 2 r 1 + B, L2 = r^2 1 + A + B L1, with A = -K/M and B = -D/M of the arm that hangs at rest. */
static void gains(mbs_real first[2][2], mbs_real second[2][2])
{
    const mbs_real m1 = 2.0, m2 = 1.0, l1 = 0.4, l2 = 0.3, g = 9.81;
    mbs_real m22 = m2 * l2 * l2 / 3.0;
    mbs_real m12 = m22 + m2 * l1 * l2 / 2.0;
    mbs_real m11 = m1 * l1 * l1 / 3.0 + m2 * l1 * l1 + m2 * l1 * l2 + m22;
    mbs_real k22 = g * m2 * l2 / 2.0;
    mbs_real k11 = g * (m1 * l1 / 2.0 + m2 * l1) + k22;
    mbs_real determinant = m11 * m22 - m12 * m12;
    const mbs_real inverse[2][2] = {{m22 / determinant, -m12 / determinant}, {-m12 / determinant, m11 / determinant}};
    const mbs_real stiffness[2][2] = {{k11, k22}, {k22, k22}}, damping[2][2] = {{0.4, 0.0}, {0.0, 0.1}};
    mbs_real b[2][2], damped[2][2];
    minus_product(inverse, stiffness, second);
    minus_product(inverse, damping, b);
    for (int i = 0; i < 2; i++) {
        for (int j = 0; j < 2; j++) {
            first[i][j] = b[i][j] + (i == j ? 2.0 * ROOT : 0.0);
        }
    }
    minus_product(b, first, damped);
    for (int i = 0; i < 2; i++) {
        for (int j = 0; j < 2; j++) {
            second[i][j] -= damped[i][j];
            if (i == j) {
                second[i][j] += ROOT * ROOT;
            }
            first[i][j] *= STEP;
            second[i][j] *= STEP;
        }
    }
}

static int observe(void)
{
    static const mbs_real torque[3] = {TORQUE, 0.0, 0.0};
    mbs_solver *solvers[2];
    for (int k = 0; k < 2; k++) {
        if (mbs_init(memory[k], MEMORY, arm_model, sizeof arm_model, &solvers[k]) != MBS_OK) {
            return 1;
        }
    }
    mbs_solver *arm = solvers[0], *observer = solvers[1];
    mbs_real y[2], z[2], v[2], errors[2], first[2][2], second[2][2];
    mbs_coordinates(arm, z, 2);
    mbs_velocities(arm, v, 2);
    for (int i = 0; i < 2; i++) {
        z[i] -= start_errors[i];
    }
    if (mbs_set_state(observer, z, 2, v, 2, NULL) != MBS_OK) {
        return 1;
    }
    gains(first, second);
    for (int step = 1; step <= STEPS; step++) {
        for (int k = 0; k < 2; k++) {
            if (mbs_set_input(solvers[k], 0, torque) != MBS_OK || mbs_step(solvers[k], STEP, NULL, NULL, NULL) != MBS_OK) {
                return 1;
            }
        }
        mbs_coordinates(arm, y, 2);
        mbs_coordinates(observer, z, 2);
        mbs_velocities(observer, v, 2);
        for (int i = 0; i < 2; i++) {
            errors[i] = y[i] - z[i];
        }
        if (step % REPORT_INTERVAL == 0) {
            write_line('o', step, errors, 2);
        }
        for (int i = 0; i < 2; i++) {
            z[i] += first[i][0] * errors[0] + first[i][1] * errors[1];
            v[i] += second[i][0] * errors[0] + second[i][1] * errors[1];
        }
        if (mbs_set_state(observer, z, 2, v, 2, NULL) != MBS_OK) {
            return 1;
        }
    }
    return 0;
}

static int close_loop(void)
{
    mbs_solver *solver;
    mbs_state_report report;
    mbs_real z[3], v[3];
    if (mbs_init(memory[2], MEMORY, linkage_model, sizeof linkage_model, &solver) != MBS_OK) {
        return 1;
    }
    mbs_coordinates(solver, z, 3);
    mbs_velocities(solver, v, 3);
    for (int i = 0; i < 3; i++) {
        z[i] += aside[i];
        v[i] += aside[i];
    }
    if (mbs_set_state(solver, z, 3, v, 3, &report) != MBS_OK) {
        return 1;
    }
    const mbs_real closed[3] = {report.moved, report.violation[0], report.violation[1]};
    write_line('c', 0, closed, 3);
    /* what is refused, by its code; the steps below have the bits of a run without */
    z[1] = __builtin_nan("");
    if (mbs_set_state(solver, z, 3, v, 3, NULL) != MBS_NOT_FINITE || mbs_set_state(solver, v, 2, v, 3, NULL) != MBS_LENGTH
        || mbs_set_state(solver, NULL, 3, v, 3, NULL) != MBS_NULL) {
        return 1;
    }
    for (int step = 1; step <= STEPS; step++) {
        if (mbs_step(solver, STEP, NULL, NULL, NULL) != MBS_OK) {
            return 1;
        }
        if (step % REPORT_INTERVAL == 0) {
            mbs_coordinates(solver, z, 3);
            write_line('s', step, z, 3);
        }
    }
    return 0;
}

int main(void)
{
    if (mbs_size() > MEMORY) {
        return 1;
    }
    return observe() != 0 || close_loop() != 0;
}
