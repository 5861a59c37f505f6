/* Andrews' squeezing mechanism for radau of R's deSolve, which is RADAU5: index 3, y = (q, v, a, lambda), M y' = f with
   M = diag(1 fourteen times, 0 thirteen times). */
#include "andrews.h"

void andrews_f(int *n, double *t, double *y, double *f, double *out, int *ip) {
  double G[42];
  for (int i = 0; i < 14; ++i) f[i] = y[i + 7];
  andrews_dynamics(y, y + 7, y + 14, y + 21, f + 14, G);
  andrews_loops(y, f + 21);
  (void)n, (void)t, (void)out, (void)ip;
}

/* The simplified matrix of Hairer and Wanner: derivatives of M, G and f are left out. */
void andrews_df(int *n, double *t, double *y, int *ml, int *mu, double *df, int *rows, double *out, int *ip) {
  double M[49], G[42];
  int ld = *rows;
  andrews_mass(y, M);
  andrews_jacobian(y, G);
  for (int i = 0; i < 14; ++i) df[i + (i + 7) * ld] = 1;
  for (int i = 0; i < 7; ++i) {
    for (int j = 0; j < 7; ++j) df[14 + i + (14 + j) * ld] = M[7 * i + j];
    for (int k = 0; k < 6; ++k) df[14 + i + (21 + k) * ld] = df[21 + k + i * ld] = G[7 * k + i];
  }
  (void)n, (void)t, (void)ml, (void)mu, (void)out, (void)ip;
}

void andrews_digits_of(double *q, double *digits) { *digits = andrews_digits(q); }
