/* A controller for ambrig, in C or in anything that can call itself C.
 *
 * A controller is a shared library with the functions below. ambrig loads it into a process of its own
 * and calls it once per controller period, in lock step with the simulated rig:
 *
 *   open    once, names and numbers of the rig are in place; may allocate and set `state`
 *   hold    optional: start so that `force` comes out while `position` and `reference` rest
 *   step    from `position`, `reference`, ... to `force` (and `command`, if the rig file says
 *           commands = "currents")
 *   track   optional: somebody else commanded `force` in this period; the state follows
 *   close   optional: once
 *
 * Each returns 0, or another number after writing a reason to `message`: this ends the run with that
 * reason. A number that is not finite, a crash, an endless loop and a library that was compiled for
 * another version of this header end the run too, never ambrig. Static data are allowed: every run has
 * a process of its own.
 *
 *   cc -std=c99 -O2 -ffp-contract=off -shared -fPIC -I FOLDER_OF_THIS_HEADER my_controller.c -o my_controller.so
 *
 *   [controller]
 *   kind = "library"
 *   file = "my_controller.so"
 *   f_max = 60.0
 *   parameters = { kp = 4.0e5 }
 *
 * Units are SI. Compiles as C99 and as C++.
 */
#ifndef AMBRIG_CONTROLLER_H
#define AMBRIG_CONTROLLER_H

#include <stdint.h>
#include <string.h>

#define AMBRIG_CONTROLLER_VERSION 1u
#define AMBRIG_CONTROLLER_MESSAGE 256

#ifdef __cplusplus
extern "C" {
#endif

typedef struct ambrig_controller {
  uint32_t size;    /* of this struct, in bytes */
  uint32_t version; /* AMBRIG_CONTROLLER_VERSION */

  /* Of the rig, constant from open to close. */
  uint32_t axes;       /* that it controls, in the rig file's order */
  uint32_t coils;      /* of the bearings that it controls */
  uint32_t parameters; /* that the rig file gives */
  uint32_t reserved;
  double period;                     /* of the controller [s] */
  const char* const* axis_name;      /* "A.x", ... */
  const char* const* coil_name;      /* "A.coil1", ... */
  const char* const* parameter_name; /* as in `parameters = { ... }` of the rig file */
  const double* parameter;
  const double* force_limit;   /* f_max per axis [N]; ambrig clamps `force` to it */
  const double* current_limit; /* per coil [A]; ambrig clamps `command` to it */

  /* Measured in this period. */
  double time;             /* since the start of the scenario; negative while the rig settles [s] */
  double speed;            /* reading of the speed sensor [rad/s] */
  const double* position;  /* readings per axis [m] */
  const double* reference; /* wanted positions per axis [m] */
  const double* excitation; /* forces per axis that the scenario asks to be added [N] */
  const double* current;    /* per coil, mean of the last switching period's samples [A] */
  const double* set_point;  /* per coil, that the current loops follow now [A] */
  const double* duty;       /* per coil, of the last switching period [-] */

  /* Wanted: filled by step. hold and track find here what was commanded. */
  double* force; /* per axis, with the excitation [N] */
  double*
      command; /* per coil, set-points of the current loops; only with commands = "currents" [A] */

  void* state; /* the controller's own */
  char message[AMBRIG_CONTROLLER_MESSAGE];
} ambrig_controller;

#if defined(_WIN32)
#define AMBRIG_CONTROLLER_API __declspec(dllexport)
#else
#define AMBRIG_CONTROLLER_API __attribute__((visibility("default")))
#endif

/* Stands once in every library: the version of this header that it was compiled with. */
#ifdef __cplusplus
#define AMBRIG_CONTROLLER_LIBRARY                                                      \
  extern "C" {                                                                         \
  extern AMBRIG_CONTROLLER_API const uint32_t ambrig_controller_version[2];            \
  const uint32_t ambrig_controller_version[2] = {AMBRIG_CONTROLLER_VERSION,            \
                                                 (uint32_t)sizeof(ambrig_controller)}; \
  }
#else
#define AMBRIG_CONTROLLER_LIBRARY                                       \
  AMBRIG_CONTROLLER_API const uint32_t ambrig_controller_version[2] = { \
      AMBRIG_CONTROLLER_VERSION, (uint32_t)sizeof(ambrig_controller)};
#endif

AMBRIG_CONTROLLER_API int ambrig_controller_open(ambrig_controller* c);
AMBRIG_CONTROLLER_API int ambrig_controller_step(ambrig_controller* c);
AMBRIG_CONTROLLER_API int ambrig_controller_hold(ambrig_controller* c);   /* optional */
AMBRIG_CONTROLLER_API int ambrig_controller_track(ambrig_controller* c);  /* optional */
AMBRIG_CONTROLLER_API void ambrig_controller_close(ambrig_controller* c); /* optional */

/* A parameter by its name, or `otherwise` where the rig file does not give it. */
static inline double ambrig_parameter(const ambrig_controller* c, const char* name,
                                      double otherwise) {
  uint32_t k;
  for (k = 0; k < c->parameters; ++k)
    if (strcmp(c->parameter_name[k], name) == 0) return c->parameter[k];
  return otherwise;
}

/* The reason of a failure, cut to the room there is; returns 1, to be returned. */
static inline int ambrig_fail(ambrig_controller* c, const char* reason) {
  size_t n = strlen(reason);
  if (n >= AMBRIG_CONTROLLER_MESSAGE) n = AMBRIG_CONTROLLER_MESSAGE - 1;
  memcpy(c->message, reason, n);
  c->message[n] = '\0';
  return 1;
}

#ifdef __cplusplus
}
#endif

#endif
