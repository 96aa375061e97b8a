/* The process in which a controller runs: loads the shared library, or is linked with the controller, and
 * answers ambrig's messages (wire.h) until the connection ends.
 *
 *   ambrig_controller_host LIBRARY                  on file descriptor 3 (how ambrig starts it)
 *   ambrig_controller_host NAME.fmu-binding         the same with an FMU (fmu_adapter.h)
 *   ambrig_controller_host LIBRARY --listen ADDRESS waits for ambrig; unix:PATH or tcp:PORT
 *   firmware --listen ADDRESS                       the same, compiled with -DAMBRIG_LINKED together with the
 *                                                   controller's sources (firmware under test)
 *
 * A listener forks for every connection, so that each run has static data of its own. Compiles as C99 with
 * POSIX 2008:  cc -std=c99 -D_GNU_SOURCE controller_host.c host_listener.c fmu_adapter.c -ldl -pthread
 */
#include <dlfcn.h>
#include <errno.h>
#include <poll.h>
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/socket.h>
#include <unistd.h>

#include "ambrig_controller.h"
#include "fmu_adapter.h"
#include "host_listener.h"
#include "wire.h"

typedef int (*call)(ambrig_controller *);

/* The controller's functions; the optional ones may be missing. */
typedef struct functions {
  call open, step, hold, track;
  void (*close)(ambrig_controller *);
} functions;

typedef struct host {
  int socket;
  functions f;
  ambrig_controller c;
  double *numbers; /* of the period, in the order of the wire */
  double *answer;  /* force, command */
  uint32_t periods_numbers;
  int ready;
} host;

static int read_all(int socket, void *to, size_t bytes) {
  char *p = to;
  while (bytes > 0) {
    const ssize_t n = recv(socket, p, bytes, 0);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) return 0;
    p += n;
    bytes -= (size_t)n;
  }
  return 1;
}

static int write_all(int socket, const void *from, size_t bytes) {
  const char *p = from;
  while (bytes > 0) {
    const ssize_t n = send(socket, p, bytes, MSG_NOSIGNAL);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) return 0;
    p += n;
    bytes -= (size_t)n;
  }
  return 1;
}

static int answer(int socket, uint32_t kind, const void *payload, uint32_t bytes) {
  char frame[sizeof(wire_header) + 1024];
  const wire_header h = {kind, bytes};
  if (bytes > 1024) return write_all(socket, &h, sizeof h) && write_all(socket, payload, bytes);
  memcpy(frame, &h, sizeof h);
  if (bytes > 0) memcpy(frame + sizeof h, payload, bytes);
  return write_all(socket, frame, sizeof h + bytes);
}

static int answer_text(int socket, const char *text) {
  return answer(socket, WIRE_FAILED, text, (uint32_t)strlen(text));
}

/* The result of one of the controller's functions: its message, or that it was refused without one. */
static int answer_result(host *h, const char *name, int result) {
  char text[AMBRIG_CONTROLLER_MESSAGE + 64];
  if (result == 0) return answer(h->socket, WIRE_DONE, NULL, 0);
  h->c.message[AMBRIG_CONTROLLER_MESSAGE - 1] = '\0';
  if (h->c.message[0] != '\0')
    snprintf(text, sizeof text, "%s says: %s", name, h->c.message);
  else
    snprintf(text, sizeof text, "%s returned %d without a message", name, result);
  return answer_text(h->socket, text);
}

/* An endless loop outlives nobody: when ambrig is gone, so is this process. */
static void *watch(void *argument) {
  struct pollfd p = {*(const int *)argument, POLLRDHUP, 0};
  while (poll(&p, 1, -1) < 0 && errno == EINTR) {
  }
  usleep(200000); /* room for close() of a controller that is waiting for the next message */
  _exit(0);
  return NULL;
}

static const char **names_in(const char **text, const char *end, uint32_t count) {
  uint32_t k;
  const char **names = calloc(count + 1, sizeof *names);
  for (k = 0; names && k < count; ++k) {
    const char *zero = memchr(*text, 0, (size_t)(end - *text));
    if (!zero) return NULL;
    names[k] = *text;
    *text = zero + 1;
  }
  return names;
}

/* Places of the fields inside the numbers of a period, in the order of wire.h. */
static void place_fields(host *h) {
  ambrig_controller *c = &h->c;
  double *p = h->numbers + 2;
  c->position = p;
  c->reference = p += c->axes;
  c->excitation = p += c->axes;
  p += c->axes; /* the force, which the controller may write to */
  c->current = p += c->axes;
  c->set_point = p += c->coils;
  c->duty = p + c->coils;
  c->force = h->answer;
  c->command = h->answer + c->axes;
}

/* Keeps the payload: names and numbers stay where they arrived. */
static const char *take_setup(host *h, const char *payload, uint32_t bytes) {
  wire_setup s;
  ambrig_controller *c = &h->c;
  if (bytes < sizeof s) return "the first message is too short";
  memcpy(&s, payload, sizeof s);
  if (s.magic != WIRE_MAGIC) return "the first message is not ambrig's";
  if (s.version != WIRE_VERSION) return "ambrig speaks another version of the protocol";
  const size_t room = bytes - sizeof s;
  const uint64_t numbers = 1 + (uint64_t)s.axes + s.coils + s.parameters;
  if (numbers > WIRE_MOST_BYTES || numbers * sizeof(double) + s.text_bytes != room)
    return "the first message has another length than it says";
  const double *number = (const double *)(const void *)(payload + sizeof s);
  const char *text = payload + sizeof s + numbers * sizeof(double);
  const char *end = text + s.text_bytes;
  c->size = (uint32_t)sizeof *c;
  c->version = AMBRIG_CONTROLLER_VERSION;
  c->axes = s.axes;
  c->coils = s.coils;
  c->parameters = s.parameters;
  c->period = number[0];
  c->force_limit = number + 1;
  c->current_limit = number + 1 + s.axes;
  c->parameter = number + 1 + s.axes + s.coils;
  c->axis_name = names_in(&text, end, s.axes);
  c->coil_name = names_in(&text, end, s.coils);
  c->parameter_name = names_in(&text, end, s.parameters);
  h->periods_numbers = 2 + 4 * s.axes + 3 * s.coils;
  h->numbers = calloc(h->periods_numbers, sizeof(double));
  h->answer = calloc(s.axes + s.coils + 1, sizeof(double));
  if (!c->axis_name || !c->coil_name || !c->parameter_name) return "the names of the first message are cut off";
  if (!h->numbers || !h->answer) return "no memory for the numbers of a period";
  place_fields(h);
  return NULL;
}

/* One period; what HOLD and TRACK command is given in `force`. */
static int period(host *h, uint32_t kind, const char *payload, uint32_t bytes) {
  ambrig_controller *c = &h->c;
  const uint32_t axes = c->axes, coils = c->coils;
  if (!h->ready) return answer_text(h->socket, "a period before the setup");
  if (bytes != h->periods_numbers * sizeof(double))
    return answer_text(h->socket, "a period's message has another length than the rig asks for");
  memcpy(h->numbers, payload, bytes);
  c->time = h->numbers[0];
  c->speed = h->numbers[1];
  c->message[0] = '\0';
  memcpy(c->force, h->numbers + 2 + 3 * axes, axes * sizeof(double));
  memcpy(c->command, c->set_point, coils * sizeof(double));
  if (kind == WIRE_HOLD) return answer_result(h, "hold", h->f.hold ? h->f.hold(c) : 0);
  if (kind == WIRE_TRACK) return answer_result(h, "track", (h->f.track ? h->f.track : h->f.step)(c));
  const int result = h->f.step(c);
  if (result != 0) return answer_result(h, "step", result);
  return answer(h->socket, WIRE_FORCE, h->answer, (uint32_t)((axes + coils) * sizeof(double)));
}

/* Until the connection ends. */
static int serve(host *h) {
  wire_header head;
  while (read_all(h->socket, &head, sizeof head)) {
    if (head.bytes > WIRE_MOST_BYTES) return !answer_text(h->socket, "a message is too long");
    char *payload = malloc(head.bytes + 1);
    if (!payload || !read_all(h->socket, payload, head.bytes)) break;
    if (head.kind == WIRE_SETUP && !h->ready) {
      const char *wrong = take_setup(h, payload, head.bytes);
      if (wrong) {
        answer_text(h->socket, wrong);
        return 1;
      }
      h->ready = 1;
      if (!answer_result(h, "open", h->f.open(&h->c))) return 1;
      continue; /* the payload holds the names */
    }
    const int told = period(h, head.kind, payload, head.bytes);
    free(payload);
    if (!told) break;
  }
  if (h->ready && h->f.close) h->f.close(&h->c);
  return 0;
}

#ifdef AMBRIG_LINKED
int ambrig_controller_hold(ambrig_controller *c) __attribute__((weak));
int ambrig_controller_track(ambrig_controller *c) __attribute__((weak));
void ambrig_controller_close(ambrig_controller *c) __attribute__((weak));

static const char *load(const char *library, functions *f) {
  static const functions linked = {ambrig_controller_open, ambrig_controller_step, ambrig_controller_hold,
                                   ambrig_controller_track, ambrig_controller_close};
  (void)library;
  *f = linked;
  return NULL;
}
#else
/* A function by its name: POSIX says that this conversion works. */
static call function(void *library, const char *name) {
  call f;
  void *p = dlsym(library, name);
  memcpy(&f, &p, sizeof f);
  return f;
}

static const char *load(const char *library, functions *f) {
  static char text[512];
  static const functions of_fmu = {fmu_open, fmu_step, NULL, NULL, fmu_close};
  if (is_fmu_binding(library)) {
    *f = of_fmu;
    return load_fmu(library);
  }
  void *l = dlopen(library, RTLD_NOW | RTLD_LOCAL);
  if (!l) {
    snprintf(text, sizeof text, "cannot be loaded: %s", dlerror());
    return text;
  }
  const uint32_t *version = dlsym(l, "ambrig_controller_version");
  if (!version) return "says no version of ambrig_controller.h (AMBRIG_CONTROLLER_LIBRARY must stand in it once)";
  if (version[0] != AMBRIG_CONTROLLER_VERSION || version[1] != sizeof(ambrig_controller)) {
    snprintf(text, sizeof text,
             "was compiled for version %u of ambrig_controller.h (%u bytes), this ambrig has version %u (%u bytes)",
             version[0], version[1], AMBRIG_CONTROLLER_VERSION, (unsigned)sizeof(ambrig_controller));
    return text;
  }
  f->open = function(l, "ambrig_controller_open");
  f->step = function(l, "ambrig_controller_step");
  f->hold = function(l, "ambrig_controller_hold");
  f->track = function(l, "ambrig_controller_track");
  const call last = function(l, "ambrig_controller_close");
  memcpy(&f->close, &last, sizeof last);
  if (!f->open || !f->step) return "has no function ambrig_controller_open or ambrig_controller_step";
  return NULL;
}
#endif

/* Tells `why` as the answer to the first message. Read first: a connection that is closed with unread bytes is reset,
 * and the other side may lose what it has not read yet. */
static int refuse(int socket, const char *why) {
  wire_header head = {0, 0};
  char byte;
  if (!read_all(socket, &head, sizeof head)) return 1;
  while (head.bytes > 0 && read_all(socket, &byte, 1)) --head.bytes;
  answer_text(socket, why);
  return 1;
}

/* The controller's whole life on this socket. */
static int live(int socket, const char *library) {
  static host h;
  static int watched;
  pthread_t thread;
  h.socket = watched = socket;
  if (pthread_create(&thread, NULL, watch, &watched) == 0) pthread_detach(thread);
  const char *wrong = load(library, &h.f);
  return wrong ? refuse(socket, wrong) : serve(&h);
}

int main(int argc, char **argv) {
  const char *library = argc > 1 ? argv[1] : "";
  int k;
  for (k = 1; k + 1 < argc; ++k)
    if (strcmp(argv[k], "--listen") == 0) return listen_at(argv[k + 1], library, live);
  if (argc != 2) {
    fprintf(stderr, "use: %s LIBRARY [--listen unix:PATH | tcp:PORT]\n", argv[0]);
    return 2;
  }
  return live(3, library);
}
