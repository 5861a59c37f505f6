/* mbs-nostd for programs in C: multibody dynamics of a model that `mbs export SCENE --binary FILE` wrote.
 *
 * No allocation, no globals: a solver lives in memory of the caller's, and any number of them may run at once.
 * Functions return 0, or one of the codes below. SI units; angles in rad. */
#ifndef MBS_H
#define MBS_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Define MBS_SINGLE where the library was built with the feature `single`. */
#ifdef MBS_SINGLE
typedef float mbs_real;
#else
typedef double mbs_real;
#endif

enum mbs_status {
    MBS_OK = 0,
    MBS_NULL = 1,      /* a pointer is null */
    MBS_MEMORY = 2,    /* the memory is too small or not aligned */
    MBS_MODEL = 3,     /* the bytes are no model, or one that is too large or has an effect that is left out */
    MBS_NO_INPUT = 4,  /* there is no such guide or course, or it is no input: nothing is set */
    MBS_STOPPED = 5,   /* the step could not be made, or there are no accelerations at a state; the state is as before */
    MBS_NOT_FINITE = 6, /* a value is infinite or NaN: nothing is set */
    MBS_LENGTH = 7,     /* a list of a state has another length than the model's: nothing is set */
    MBS_QUATERNION = 8, /* a quaternion of a state has no direction: nothing is set */
    MBS_OPEN = 9        /* the loops stay open from a state: nothing is set */
};

typedef struct mbs_solver mbs_solver;

/* What a step did, and what it left over. */
typedef struct mbs_report {
    uint32_t evaluations;
    uint32_t projections;
    mbs_real correction;   /* last change of a coordinate [m or rad] */
    mbs_real violation[3]; /* of the loops: positions, velocities, accelerations */
    uint32_t is_cut_short; /* time ran out */
} mbs_report;

/* What setting a state did, and what it left over. */
typedef struct mbs_state_report {
    uint32_t evaluations;  /* of the accelerations: one, with closed loops two, far off up to five */
    uint32_t responses;    /* sweeps that close loops or refine accelerations, each about a fifth of an evaluation */
    mbs_real moved;        /* largest change of a coordinate [m, rad or, of quaternions, 1] */
    mbs_real violation[3]; /* of the loops: positions, velocities, accelerations */
} mbs_state_report;

/* Is there time for more? Asked within a step; null: there always is. */
typedef int (*mbs_watch)(void *context);

/* Bytes that a solver needs, and their alignment. */
size_t mbs_size(void);
size_t mbs_align(void);

/* Reads a model into `memory`; afterwards the bytes of the model are not needed. */
int mbs_init(void *memory, size_t size, const uint8_t *model, size_t n, mbs_solver **solver);

/* Inputs, between steps: a guide's value, rate and acceleration at the end of the next step; a course's vector,
 * with which the next step is made from its beginning. The scene's signals are the first courses, in their order, and
 * an input among them is { value, 0, 0 }. */
int mbs_set_guide(mbs_solver *solver, size_t guide, const mbs_real motion[3]);
int mbs_set_input(mbs_solver *solver, size_t course, const mbs_real value[3]);
#define mbs_set_course mbs_set_input /* its former name */

/* Work of a step: evaluations (at least one), further sweeps, projections. */
int mbs_set_bounds(mbs_solver *solver, uint32_t evaluations, uint32_t sweeps, uint32_t projections);

/* One step of `dt` seconds. `report` and `watch` may be null. */
int mbs_step(mbs_solver *solver, mbs_real dt, mbs_watch watch, void *context, mbs_report *report);

/* Puts the model into another state at the present time, as an observer does: `z` and `v` have the numbers, units and order of
 * `mbs_coordinates` and `mbs_velocities`, `n_z` and `n_v` as many as these return. In the order of the exported links:
 *   revolute, prismatic   angle [rad] or slide [m]; rate
 *   ball                  quaternion (w, x, y, z) against the parent; angular velocity against it, in the link's axes
 *   free                  quaternion against the ground, position of the link's origin from `mbs_base` in global axes [m];
 *                         angular velocity in the link's axes, velocity in global axes [m/s]
 *   guided                none
 * A quaternion q and its negative -q are the same attitude, but not the same twist of a bushing or a torsion spring: give the one nearer
 * to the present quaternion. All loops are closed together by the smallest move in the norm of the masses to first order, positions first.
 * Velocities are projected along the same directions. In a model with loops any coordinate may move. In one without, all are taken to the
 * bit, but for quaternions that are not unit. Accelerations are evaluated anew, and the next step starts from there.
 * Time, inputs and states of signals stay; guides are where the last step ended. `report` may be null.
 *
 * Cost: one evaluation; with loops two, and a response for each of some five sweeps; far off at most five and 185. Allocates nothing.
 * Errors: MBS_NULL, MBS_LENGTH, MBS_NOT_FINITE, MBS_QUATERNION, MBS_OPEN; MBS_STOPPED: no accelerations there. All is then as before. */
int mbs_set_state(mbs_solver *solver, const mbs_real *z, size_t n_z, const mbs_real *v, size_t n_v,
                  mbs_state_report *report);

/* Copies at most `n` numbers; returns how many there are. `mbs_base` is the point that positions of free links are counted from, global
 * axes [m]. */
size_t mbs_base(const mbs_solver *solver, mbs_real *to, size_t n);
size_t mbs_coordinates(const mbs_solver *solver, mbs_real *to, size_t n);
size_t mbs_velocities(const mbs_solver *solver, mbs_real *to, size_t n);
size_t mbs_accelerations(const mbs_solver *solver, mbs_real *to, size_t n);
mbs_real mbs_time(const mbs_solver *solver);

#ifdef __cplusplus
}
#endif

#endif
