/* An FMU for FMI 2.0 and 3.0 as another tool would make it: PI control with damping of up to four axes, and what a
 * controller can do wrong. Value references: 0..3 position, 4..7 force, 8 kp (parameter), 9 mistake (parameter, an
 * Integer or Int32), 10 speed. */
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "plain_pi.h"

typedef struct component {
  double real[11];
  int mistake;
  plain_pi law[4];
  void (*log2)(void *, const char *, int, const char *, const char *, ...);
  void (*log3)(void *, int, const char *, const char *);
  double last;
} component;

typedef struct callbacks {
  void (*logger)(void *, const char *, int, const char *, const char *, ...);
} callbacks;

static component *make(const char *token) {
  component *c = strcmp(token, "{4f1c}") == 0 ? calloc(1, sizeof *c) : NULL;
  if (c) c->real[8] = 3e5;
  return c;
}

static int step(component *c, double t, double h) {
  volatile int zero = 0;
  int k;
  if (t - c->last > 1e-12 || c->last - t > 1e-12) return 3;
  c->last = t + h;
  for (k = 0; k < 4; ++k) c->real[4 + k] = plain_pi_step(&c->law[k], c->real[8], -c->real[k], h);
  if (c->mistake == 1) c->real[5] = 0.0 / (zero * 1.0);
  if (c->mistake == 2) return 7 / zero;
  if (c->mistake == 3) *(volatile int *)(intptr_t)zero = 1;
  while (c->mistake == 4) {
  }
  if (c->mistake == 5 && c->log2) c->log2(NULL, "c", 3, "error", "the %s is lost", "plant");
  if (c->mistake == 5 && c->log3) c->log3(NULL, 3, "error", "the plant is lost");
  if (c->mistake == 6) exit(5);
  return c->mistake == 5 ? 3 : 0;
}

static int set(component *c, const unsigned *r, size_t n, const double *v) {
  size_t k;
  for (k = 0; k < n; ++k) c->real[r[k]] = v[k];
  return 0;
}
static int get(component *c, const unsigned *r, size_t n, double *v) {
  size_t k;
  for (k = 0; k < n; ++k) v[k] = c->real[r[k]];
  return 0;
}

void *fmi2Instantiate(const char *name, int type, const char *guid, const char *place, const callbacks *f, int visible, int log) {
  component *c = make(guid);
  (void)name, (void)visible, (void)log;
  if (c) c->log2 = f->logger;
  return type == 1 && strncmp(place, "file:///", 8) == 0 ? c : NULL;
}
void fmi2FreeInstance(void *c) { free(c); }
int fmi2SetupExperiment(void *c, int tolerance, double t, double start, int stop, double end) {
  (void)tolerance, (void)t, (void)stop, (void)end;
  ((component *)c)->last = start;
  return 0;
}
int fmi2EnterInitializationMode(void *c) { return c ? 0 : 3; }
int fmi2ExitInitializationMode(void *c) { return c ? 0 : 3; }
int fmi2Terminate(void *c) { return c ? 0 : 3; }
int fmi2SetReal(void *c, const unsigned *r, size_t n, const double *v) { return set(c, r, n, v); }
int fmi2GetReal(void *c, const unsigned *r, size_t n, double *v) { return get(c, r, n, v); }
int fmi2SetInteger(void *c, const unsigned *r, size_t n, const int *v) {
  (void)r, (void)n;
  ((component *)c)->mistake = v[0];
  return 0;
}
int fmi2DoStep(void *c, double t, double h, int no_return) {
  (void)no_return;
  return step(c, t, h);
}

void *fmi3InstantiateCoSimulation(const char *name, const char *token, const char *place, bool visible, bool log, bool events, bool early,
                                  const unsigned *required, size_t n, void *environment,
                                  void (*logger)(void *, int, const char *, const char *), void *update) {
  component *c = make(token);
  (void)name, (void)place, (void)visible, (void)log, (void)events, (void)early, (void)required, (void)n, (void)environment, (void)update;
  if (c) c->log3 = logger;
  return c;
}
void fmi3FreeInstance(void *c) { free(c); }
int fmi3EnterInitializationMode(void *c, bool tolerance, double t, double start, bool stop, double end) {
  (void)tolerance, (void)t, (void)stop, (void)end;
  ((component *)c)->last = start;
  return 0;
}
int fmi3ExitInitializationMode(void *c) { return c ? 0 : 3; }
int fmi3Terminate(void *c) { return c ? 0 : 3; }
int fmi3SetFloat64(void *c, const unsigned *r, size_t n, const double *v, size_t count) { return n == count ? set(c, r, n, v) : 3; }
int fmi3GetFloat64(void *c, const unsigned *r, size_t n, double *v, size_t count) { return n == count ? get(c, r, n, v) : 3; }
int fmi3SetInt32(void *c, const unsigned *r, size_t n, const int *v, size_t count) {
  return n == count ? fmi2SetInteger(c, r, n, v) : 3;
}
int fmi3DoStep(void *c, double t, double h, bool no_state, bool *event, bool *end, bool *early, double *last) {
  (void)no_state;
  *event = *end = *early = false;
  *last = t + h;
  return step(c, t, h);
}
