/* What the MuJoCo programs share: the clock. */
#pragma once
#include <stdlib.h>
#include <time.h>

enum { STATES = 8, BATCHES = 7 };

/* CPU time of this process [s]. */
static inline double now(void) {
  struct timespec t;
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return t.tv_sec + 1e-9 * t.tv_nsec;
}

static inline int compare(const void *a, const void *b) {
  double x = *(const double *)a, y = *(const double *)b;
  return x < y ? -1 : x > y;
}

/* CPU seconds for one call: the median of batches, each of n calls, that fill `seconds` together. */
static inline double time_of(double (*batch)(void *, long), void *what, double seconds) {
  long n = 1;
  while (batch(what, n) < seconds / (2 * BATCHES)) n *= 2;
  double times[BATCHES];
  for (int i = 0; i < BATCHES; ++i) times[i] = batch(what, n) / n;
  qsort(times, BATCHES, sizeof(double), compare);
  return times[BATCHES / 2];
}
