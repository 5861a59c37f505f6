/* Andrews' squeezing mechanism in seven angles q = (beta, Theta, gamma, Phi, delta, Omega, epsilon) and six loop
   equations, as in Hairer and Wanner II, section VII.7, by the names of the test set for initial value problems:
   M a + G' lambda = f,  g = 0,  G v = 0,  G a + bias = 0. Lengths in m, masses in kg. */
#ifndef ANDREWS_H
#define ANDREWS_H
#include <math.h>
#include <string.h>

static const double M1 = .04325, M2 = .00365, M3 = .02373, M4 = .00706, M5 = .07050, M6 = .00706, M7 = .05498;
static const double I1 = 2.194e-6, I2 = 4.410e-7, I3 = 5.255e-6, I4 = 5.667e-7, I5 = 1.169e-5, I6 = 5.667e-7,
                    I7 = 1.912e-5;
static const double XA = -.06934, YA = -.00227, XB = -.03635, YB = .03273, XC = .014, YC = .072;
static const double STIFFNESS = 4530., FREE = .07785, TORQUE = .033;
static const double D = .028, DA = .0115, E = .02, EA = .01421, RR = .007, RA = .00092;
static const double SS = .035, SA = .01874, SB = .01043, SC = .018, SD = .02, TA = .02308, TB = .00916;
static const double U = .04, UA = .01228, UB = .00449, ZF = .02, ZT = .04, FA = .01421;

/* Start of the test set, and the angles at 0.03 s by extrapolation with 30 digits. */
static const double Q0[7] = {-.0617138900142764496358948458001, 0, .455279819163070380255912382449,
  .222668390165885884674473185609, .487364979543842550225598953530, -.222668390165885884674473185609,
  1.23054744454982119249735015568};
static const double A0[7] = {14222.4439199541138705911625887, -10666.8329399655854029433719415, 0, 0, 0, 0, 0};
static const double LAMBDA0[6] = {98.5668703962410896057654982170, -6.12268834425566265503114393122, 0, 0, 0, 0};
static const double END[7] = {15.810771195153707097, -15.75637105841183947, .0408222401196458049,
  -.5347301163420795938, .5244099658799540694, .5347301163420795938, 1.0480807410419378731};

/* Right digits: -log10 of the largest relative error of the seven angles. */
static inline double andrews_digits(const double *q) {
  double worst = 0;
  for (int i = 0; i < 7; ++i) {
    double error = fabs((q[i] - END[i]) / END[i]);
    if (!(error < worst)) worst = error;
  }
  return -log10(worst);
}

/* M, 7 by 7. */
static inline void andrews_mass(const double *q, double M[49]) {
  double ct = cos(q[1]), sp = sin(q[3]), so = sin(q[5]), a = E - EA, b = ZF - FA;
  memset(M, 0, 49 * sizeof(double));
  M[0] = M1 * RA * RA + M2 * (RR * RR - 2 * DA * RR * ct + DA * DA) + I1 + I2;
  M[1] = M[7] = M2 * (DA * DA - DA * RR * ct) + I2;
  M[8] = M2 * DA * DA + I2;
  M[16] = M3 * (SA * SA + SB * SB) + I3;
  M[24] = M4 * a * a + I4;
  M[25] = M[31] = M4 * (a * a + ZT * a * sp) + I4;
  M[32] = M4 * (ZT * ZT + 2 * ZT * a * sp + a * a) + M5 * (TA * TA + TB * TB) + I4 + I5;
  M[40] = M6 * b * b + I6;
  M[41] = M[47] = M6 * (b * b - U * b * so) + I6;
  M[48] = M6 * (b * b - 2 * U * b * so + U * U) + M7 * (UA * UA + UB * UB) + I6 + I7;
}

/* f. */
static inline void andrews_force(const double *q, const double *v, double f[7]) {
  double s = sin(q[2]), c = cos(q[2]), a = E - EA, b = ZF - FA;
  double x = SD * c + SC * s + XB - XC, y = SD * s - SC * c + YB - YC;
  double length = sqrt(x * x + y * y), pull = -STIFFNESS * (length - FREE) / length;
  f[0] = TORQUE - M2 * DA * RR * v[1] * (v[1] + 2 * v[0]) * sin(q[1]);
  f[1] = M2 * DA * RR * v[0] * v[0] * sin(q[1]);
  f[2] = pull * (x * (SC * c - SD * s) + y * (SD * c + SC * s));
  f[3] = M4 * ZT * a * v[4] * v[4] * cos(q[3]);
  f[4] = -M4 * ZT * a * v[3] * (v[3] + 2 * v[4]) * cos(q[3]);
  f[5] = -M6 * U * b * v[6] * v[6] * cos(q[5]);
  f[6] = M6 * U * b * v[5] * (v[5] + 2 * v[6]) * cos(q[5]);
}

/* g. */
static inline void andrews_loops(const double *q, double g[6]) {
  double x = RR * cos(q[0]) - D * cos(q[0] + q[1]), y = RR * sin(q[0]) - D * sin(q[0] + q[1]);
  g[0] = x - SS * sin(q[2]) - XB;
  g[1] = y + SS * cos(q[2]) - YB;
  g[2] = x - E * sin(q[3] + q[4]) - ZT * cos(q[4]) - XA;
  g[3] = y + E * cos(q[3] + q[4]) - ZT * sin(q[4]) - YA;
  g[4] = x - ZF * cos(q[5] + q[6]) - U * sin(q[6]) - XA;
  g[5] = y - ZF * sin(q[5] + q[6]) + U * cos(q[6]) - YA;
}

/* G, 6 by 7, row by row. */
static inline void andrews_jacobian(const double *q, double G[42]) {
  double s1 = RR * sin(q[0]), c1 = RR * cos(q[0]), s2 = D * sin(q[0] + q[1]), c2 = D * cos(q[0] + q[1]);
  double s4 = E * sin(q[3] + q[4]), c4 = E * cos(q[3] + q[4]), s6 = ZF * sin(q[5] + q[6]), c6 = ZF * cos(q[5] + q[6]);
  memset(G, 0, 42 * sizeof(double));
  for (int r = 0; r < 6; r += 2) {
    G[7 * r] = s2 - s1;
    G[7 * r + 1] = s2;
    G[7 * r + 7] = c1 - c2;
    G[7 * r + 8] = -c2;
  }
  G[2] = -SS * cos(q[2]);
  G[9] = -SS * sin(q[2]);
  G[17] = -c4;
  G[18] = ZT * sin(q[4]) - c4;
  G[24] = -s4;
  G[25] = -s4 - ZT * cos(q[4]);
  G[33] = s6;
  G[34] = s6 - U * cos(q[6]);
  G[40] = -c6;
  G[41] = -c6 - U * sin(q[6]);
}

/* What G a lacks of the second rate of g. */
static inline void andrews_bias(const double *q, const double *v, double h[6]) {
  double w1 = v[0] * v[0], w2 = (v[0] + v[1]) * (v[0] + v[1]), w3 = v[2] * v[2];
  double w4 = (v[3] + v[4]) * (v[3] + v[4]), w5 = v[4] * v[4], w6 = (v[5] + v[6]) * (v[5] + v[6]), w7 = v[6] * v[6];
  double x = D * cos(q[0] + q[1]) * w2 - RR * cos(q[0]) * w1, y = D * sin(q[0] + q[1]) * w2 - RR * sin(q[0]) * w1;
  h[0] = x + SS * sin(q[2]) * w3;
  h[1] = y - SS * cos(q[2]) * w3;
  h[2] = x + E * sin(q[3] + q[4]) * w4 + ZT * cos(q[4]) * w5;
  h[3] = y - E * cos(q[3] + q[4]) * w4 + ZT * sin(q[4]) * w5;
  h[4] = x + ZF * cos(q[5] + q[6]) * w6 + U * sin(q[6]) * w7;
  h[5] = y + ZF * sin(q[5] + q[6]) * w6 - U * cos(q[6]) * w7;
}

/* r = M a - f + G' lambda, and G. */
static inline void andrews_dynamics(const double *q, const double *v, const double *a, const double *lambda,
                                    double r[7], double G[42]) {
  double M[49], f[7];
  andrews_mass(q, M);
  andrews_force(q, v, f);
  andrews_jacobian(q, G);
  for (int i = 0; i < 7; ++i) {
    r[i] = -f[i];
    for (int j = 0; j < 7; ++j) r[i] += M[7 * i + j] * a[j];
    for (int k = 0; k < 6; ++k) r[i] += G[7 * k + i] * lambda[k];
  }
}
#endif
