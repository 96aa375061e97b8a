/* Waiting for ambrig at a Unix or TCP socket: one process per connection. */
#ifndef AMBRIG_HOST_LISTENER_H
#define AMBRIG_HOST_LISTENER_H

/* `address`: unix:PATH or tcp:PORT (of this machine only). Does not return unless it cannot listen. */
int listen_at(const char* address, const char* library,
              int (*live)(int socket, const char* library));

#endif
