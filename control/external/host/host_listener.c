#include "host_listener.h"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

/* A socket that listens at unix:PATH or tcp:PORT (this machine only), or -1. */
static int listener(const char *address) {
  int s = -1, one = 1;
  struct stat old;
  if (strncmp(address, "unix:", 5) == 0) {
    struct sockaddr_un a;
    memset(&a, 0, sizeof a);
    a.sun_family = AF_UNIX;
    if (strlen(address + 5) >= sizeof a.sun_path) return -1;
    strcpy(a.sun_path, address + 5);
    if (stat(a.sun_path, &old) == 0 && S_ISSOCK(old.st_mode)) unlink(a.sun_path);
    s = socket(AF_UNIX, SOCK_STREAM, 0);
    if (bind(s, (const struct sockaddr *)&a, sizeof a) != 0) return -1;
  } else if (strncmp(address, "tcp:", 4) == 0) {
    struct sockaddr_in a;
    memset(&a, 0, sizeof a);
    a.sin_family = AF_INET;
    a.sin_port = htons((uint16_t)atoi(address + 4));
    a.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    s = socket(AF_INET, SOCK_STREAM, 0);
    setsockopt(s, SOL_SOCKET, SO_REUSEADDR, &one, sizeof one);
    if (bind(s, (const struct sockaddr *)&a, sizeof a) != 0) return -1;
  }
  return s >= 0 && listen(s, 64) == 0 ? s : -1;
}

/* One process per connection, until killed. */
int listen_at(const char *address, const char *library, int (*live)(int socket, const char *library)) {
  const int s = listener(address);
  if (s < 0) {
    fprintf(stderr, "%s: cannot listen here (allowed: unix:PATH, tcp:PORT)\n", address);
    return 2;
  }
  signal(SIGCHLD, SIG_IGN);
  fprintf(stderr, "waiting for ambrig at %s\n", address);
  for (;;) {
    int one = 1;
    const int connection = accept(s, NULL, NULL);
    if (connection < 0) continue;
    setsockopt(connection, IPPROTO_TCP, TCP_NODELAY, &one, sizeof one);
    if (fork() == 0) {
      close(s);
      exit(live(connection, library));
    }
    close(connection);
  }
}
