/* MuJoCo on chains, a tree, four-bars and a step: mujoco (chain | tree | four-bars | step) N SECONDS */
#include <mujoco/mujoco.h>
#include "clock.h"
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

/* A rod of 1 m and 1 kg on a hinge about z at x of its parent. */
static mjsBody *add_rod(mjsBody *parent, double x, const char *name) {
  mjsBody *body = mjs_addBody(parent, NULL);
  if (name) mjs_setName(body->element, name);
  body->pos[0] = x;
  body->mass = 1;
  body->ipos[0] = 0.5;
  body->inertia[0] = 1e-3;
  body->inertia[1] = body->inertia[2] = 1.0 / 12;
  body->explicitinertial = 1;
  mjsJoint *joint = mjs_addJoint(body, NULL);
  joint->type = mjJNT_HINGE;
  joint->axis[0] = joint->axis[1] = 0;
  joint->axis[2] = 1;
  return body;
}

static void grow(mjsBody *parent, int i, int n) {
  mjsBody *body = add_rod(parent, i ? 1 : 0, NULL);
  for (int child = 2 * i + 1; child <= 2 * i + 2; ++child)
    if (child < n) grow(body, child, n);
}

/* Cranks 1 m apart, couplers on all but the last, their ends connected to the next crank. */
static void add_four_bars(mjSpec *spec, mjsBody *world, int n) {
  char name[32];
  for (int j = 0; j <= n; ++j) {
    sprintf(name, "crank%d", j);
    mjsBody *crank = add_rod(world, j, name);
    sprintf(name, "coupler%d", j);
    if (j < n) add_rod(crank, 1, name);
  }
  for (int i = 0; i < n; ++i) {
    mjsEquality *connect = mjs_addEquality(spec, NULL);
    connect->type = mjEQ_CONNECT;
    connect->objtype = mjOBJ_BODY;
    /* the joint at the coupler's end; the default is a polynomial */
    memset(connect->data, 0, sizeof connect->data);
    connect->data[0] = 1;
    sprintf(name, "coupler%d", i);
    mjs_setString(connect->name1, name);
    sprintf(name, "crank%d", i + 1);
    mjs_setString(connect->name2, name);
  }
}

static mjModel *model_of(const char *problem, int n) {
  mjSpec *spec = mj_makeSpec();
  spec->option.gravity[0] = spec->option.gravity[2] = 0;
  spec->option.gravity[1] = -9.81;
  spec->option.timestep = 1e-3;
  spec->option.disableflags |= mjDSBL_CONTACT;
  spec->memory = 2LL << 30;
  mjsBody *body = mjs_findBody(spec, "world");
  if (!strcmp(problem, "tree")) grow(body, 0, n);
  else if (!strcmp(problem, "four-bars")) add_four_bars(spec, body, n);
  else for (int i = 0; i < n; ++i) body = add_rod(body, i ? 1 : 0, NULL);
  mjModel *model = mj_compile(spec, NULL);
  mj_deleteSpec(spec);
  return model;
}

/* The same numbers in every program; four-bars stand alike in all states. */
static double states[STATES][2][1024];
static void make_states(int n, int is_four_bars) {
  uint32_t seed = 1;
  for (int k = 0; k < STATES; ++k)
    for (int part = 0; part < 2; ++part)
      for (int i = 0; i < n; ++i) {
        seed = seed * 1664525u + 1013904223u;
        double x = (seed >> 8) / 16777216.0 * 2.0 - 1.0;
        /* crank and coupler by turns */
        double sign = i % 2 ? -1 : 1;
        states[k][part][i] = is_four_bars ? sign * (part ? -1.0 : 1.2) : part ? x : 3 * x;
      }
}

static void set(const mjModel *m, mjData *d, int k) {
  memcpy(d->qpos, states[k][0], sizeof(double) * m->nq);
  memcpy(d->qvel, states[k][1], sizeof(double) * m->nv);
}

/* CPU seconds for n evaluations, or for n steps on from the first state. */
struct run { const mjModel *m; mjData *d; int is_step; };

static double batch(void *what, long n) {
  const struct run *run = what;
  const mjModel *m = run->m;
  mjData *d = run->d;
  int is_step = run->is_step;
  set(m, d, 0);
  d->time = 0;
  double start = now();
  for (long i = 0; i < n; ++i) {
    if (is_step) { mj_step(m, d); continue; }
    set(m, d, i % STATES);
    mju_zero(d->qacc_warmstart, m->nv);
    mj_forward(m, d);
  }
  return now() - start;
}

int main(int argc, char **argv) {
  if (argc == 2 && !strcmp(argv[1], "version")) return printf("%s\n", mj_versionString()), 0;
  if (argc != 4) return fprintf(stderr, "mujoco (chain | tree | four-bars | step) N SECONDS\n"), 1;
  int n = atoi(argv[2]), is_step = !strcmp(argv[1], "step");
  mjModel *m = model_of(argv[1], n);
  if (!m || m->nv > 1024) return fprintf(stderr, "no model of %s %d\n", argv[1], n), 1;
  if (is_step) m->opt.integrator = mjINT_RK4;
  mjData *d = mj_makeData(m);
  make_states(m->nv, !strcmp(argv[1], "four-bars"));
  struct run run = { m, d, is_step };
  double seconds = time_of(batch, &run, atof(argv[3]));
  set(m, d, 0);
  mju_zero(d->qacc_warmstart, m->nv);
  if (is_step) {
    mj_step(m, d);
    printf("mj_step RK4,%.6e,%.17g,exact\n", seconds, d->qpos[0]);
  } else {
    mj_forward(m, d);
    printf("mj_forward,%.6e,%.17g,exact\n", seconds, d->qacc[0]);
  }
  return 0;
}
