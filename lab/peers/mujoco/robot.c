/* MuJoCo on robots: mujoco_robot PROBLEM N SECONDS, for the robot of N freedoms that robots.py made */
#include <mujoco/mujoco.h>
#include "clock.h"
#include <stdio.h>
#include <string.h>

/* The first freedom that is no base's. */
static int first_joint(const mjModel *m) { return m->jnt_type[0] == mjJNT_FREE ? 6 : 0; }

/* All joints alike, the base at rest where it is drawn. */
static void set(const mjModel *m, mjData *d, int k) {
  int first = first_joint(m);
  for (int i = first; i < m->nv; ++i) {
    d->qpos[m->nq - m->nv + i] = 0.2 + 0.1 * k;
    d->qvel[i] = d->qacc[i] = 0.5;
  }
  for (int i = 0; i < first; ++i) d->qvel[i] = d->qacc[i] = 0;
}

/* The last joint of the text: every program has the Jacobian of its body. */
static int last_joint(const mjModel *m, const char *path) {
  char line[4096], name[256] = "";
  FILE *file = fopen(path, "r");
  while (file && fgets(line, sizeof line, file)) sscanf(line, "%*s %*s %255s", name);
  if (file) fclose(file);
  return mj_name2id(m, mjOBJ_JOINT, name);
}

static int last;
static double jacobian[2][3 * 1024];

static void call(const mjModel *m, mjData *d, const char *problem, int k) {
  set(m, d, k);
  if (!strcmp(problem, "robot-forward")) {
    mju_zero(d->qacc_warmstart, m->nv);
    mj_forward(m, d);
  } else if (!strcmp(problem, "robot-inverse")) {
    mj_inverse(m, d);
  } else {
    mj_kinematics(m, d);
    mj_comPos(m, d);
    if (!strcmp(problem, "robot-mass")) mj_makeM(m, d);
    else mj_jac(m, d, jacobian[0], jacobian[1], d->xanchor + 3 * last, m->jnt_bodyid[last]);
  }
}

static double value(const mjModel *m, mjData *d, const char *problem) {
  static double mass[1024 * 256];
  double sum = 0;
  call(m, d, problem, 0);
  if (!strcmp(problem, "robot-mass")) mj_fullM(m, d, mass);
  for (int i = first_joint(m); i < m->nv; ++i) {
    if (!strcmp(problem, "robot-forward")) sum += d->qacc[i];
    else if (!strcmp(problem, "robot-inverse")) sum += d->qfrc_inverse[i];
    else if (!strcmp(problem, "robot-mass")) sum += mass[i * (m->nv + 1)];
    else for (int k = 0; k < 6; ++k) {
      double x = jacobian[k / 3][k % 3 * m->nv + i];
      sum += x * x;
    }
  }
  return sum;
}

struct asked { const mjModel *m; mjData *d; const char *problem; };

/* CPU seconds for n calls. */
static double batch(void *what, long n) {
  const struct asked *asked = what;
  double start = now();
  for (long k = 0; k < n; ++k) call(asked->m, asked->d, asked->problem, k % STATES);
  return now() - start;
}

int main(int argc, char **argv) {
  if (argc == 2 && !strcmp(argv[1], "version")) return printf("%s\n", mj_versionString()), 0;
  if (argc != 4) return fprintf(stderr, "mujoco_robot PROBLEM N SECONDS\n"), 1;
  char path[4096];
  snprintf(path, sizeof path, "%s/robots/%s.mjb", getenv("PEERS_DIR"), argv[2]);
  mjModel *m = mj_loadModel(path, NULL);
  if (!m || m->nv > 256) return fprintf(stderr, "no robot of %s freedoms\n", argv[2]), 1;
  snprintf(path, sizeof path, "%s/robots/%s.txt", getenv("PEERS_DIR"), argv[2]);
  last = last_joint(m, path);
  if (last < 0) return fprintf(stderr, "no last joint\n"), 1;
  m->opt.disableflags |= mjDSBL_CONTACT | mjDSBL_LIMIT;
  mjData *d = mj_makeData(m);
  struct asked asked = { m, d, argv[1] };
  double seconds = time_of(batch, &asked, atof(argv[3]));
  const char *algorithm = !strcmp(argv[1], "robot-forward") ? "mj_forward" : !strcmp(argv[1], "robot-inverse") ? "mj_inverse"
    : !strcmp(argv[1], "robot-mass") ? "mj_makeM" : "mj_jac";
  printf("%s,%.6e,%.17g,exact\n", algorithm, seconds, value(m, d, argv[1]));
  return 0;
}
