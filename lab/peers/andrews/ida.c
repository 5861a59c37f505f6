/* Andrews' squeezing mechanism by IDA of SUNDIALS: ida andrews 7 SECONDS
   Index 1, y = (q, v, a, lambda), and the stabilised index 2 of Gear, Gupta and Leimkuhler, with six multipliers more.
   A line for each tolerance; its value is the number of right digits at 0.03 s. */
#include "andrews.h"
#include <ida/ida.h>
#include <nvector/nvector_serial.h>
#include <stdio.h>
#include <stdlib.h>
#include <sundials/sundials_version.h>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunmatrix/sunmatrix_dense.h>
#include <time.h>

enum { BATCHES = 7, LARGEST = 33 };

static double now(void) {
  struct timespec t;
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return t.tv_sec + 1e-9 * t.tv_nsec;
}

static int residual(realtype t, N_Vector yy, N_Vector yp, N_Vector rr, void *user) {
  double *y = NV_DATA_S(yy), *rate = NV_DATA_S(yp), *r = NV_DATA_S(rr), *a = y + 14, G[42], h[6];
  int is_index_1 = NV_LENGTH_S(yy) == 27;
  andrews_dynamics(y, y + 7, a, y + 21, r + 14, G);
  for (int i = 0; i < 7; ++i) {
    r[i] = rate[i] - y[7 + i];
    r[7 + i] = rate[7 + i] - a[i];
  }
  if (is_index_1) andrews_bias(y, y + 7, h);
  for (int k = 0; k < 6; ++k) {
    r[21 + k] = is_index_1 ? h[k] : 0;
    for (int j = 0; j < 7; ++j) {
      r[21 + k] += G[7 * k + j] * (is_index_1 ? a : y + 7)[j];
      if (!is_index_1) r[j] += G[7 * k + j] * y[27 + k];
    }
  }
  if (!is_index_1) andrews_loops(y, r + 27);
  (void)t, (void)user;
  return 0;
}

/* One run: CPU seconds, or -1 where the solver stops. */
static double run(int n, double tolerance, double *digits) {
  SUNContext context;
  SUNContext_Create(NULL, &context);
  N_Vector y = N_VNew_Serial(n, context), rate = N_VClone(y), kind = N_VClone(y), absolute = N_VClone(y);
  N_VConst(0, y);
  N_VConst(0, rate);
  /* accelerations and multipliers are of the order of 1e4 */
  for (int i = 0; i < n; ++i) {
    NV_Ith_S(kind, i) = i < 14;
    NV_Ith_S(absolute, i) = i < 14 ? tolerance : tolerance * 1e4;
  }
  for (int i = 0; i < 7; ++i) {
    NV_Ith_S(y, i) = Q0[i];
    NV_Ith_S(y, 14 + i) = NV_Ith_S(rate, 7 + i) = A0[i];
    if (i < 6) NV_Ith_S(y, 21 + i) = LAMBDA0[i];
  }
  double start = now();
  void *ida = IDACreate(context);
  IDAInit(ida, residual, 0, y, rate);
  IDASVtolerances(ida, tolerance, absolute);
  IDASetId(ida, kind);
  IDASetMaxNumSteps(ida, 1000000);
  if (n != 27) {
    IDASetSuppressAlg(ida, 1);
    IDASetInitStep(ida, 1e-7);
  }
  SUNMatrix matrix = SUNDenseMatrix(n, n, context);
  SUNLinearSolver solver = SUNLinSol_Dense(y, matrix, context);
  IDASetLinearSolver(ida, solver, matrix);
  IDASetStopTime(ida, .03);
  realtype t;
  int flag = IDASolve(ida, .03, &t, y, rate, IDA_NORMAL);
  double seconds = now() - start;
  *digits = andrews_digits(NV_DATA_S(y));
  IDAFree(&ida);
  SUNLinSolFree(solver);
  SUNMatDestroy(matrix);
  N_VDestroy(y), N_VDestroy(rate), N_VDestroy(kind), N_VDestroy(absolute);
  SUNContext_Free(&context);
  return flag < 0 ? -1 : seconds;
}

static int compare(const void *a, const void *b) {
  double x = *(const double *)a, y = *(const double *)b;
  return x < y ? -1 : x > y;
}

static void measure(const char *name, int n, double tolerance, double seconds) {
  double digits, times[BATCHES], first = run(n, tolerance, &digits);
  if (first < 0) return;
  int runs = (int)(seconds / BATCHES / first) + 1;
  for (int i = 0; i < BATCHES; ++i) {
    times[i] = 0;
    for (int k = 0; k < runs; ++k) times[i] += run(n, tolerance, &digits) / runs;
  }
  qsort(times, BATCHES, sizeof(double), compare);
  printf("%s %.1e,%.6e,%.17g,digits\n", name, tolerance, times[BATCHES / 2], digits);
  fflush(stdout);
}

int main(int argc, char **argv) {
  if (argc == 2) return printf("%s\n", SUNDIALS_VERSION), 0;
  if (argc != 4) return fprintf(stderr, "ida andrews 7 SECONDS\n"), 1;
  for (int i = 0; i <= 18; ++i) {
    double tolerance = pow(10, -3 - .5 * i);
    measure("IDA index 1", 27, tolerance, atof(argv[3]));
    measure("IDA index 2", LARGEST, tolerance, atof(argv[3]));
  }
  return 0;
}
