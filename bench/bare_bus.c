/* The same bytes as one bus cycle of a5, bounced by two bare programs over the same transport: UDP multicast on
   loopback, one datagram per frame, sent and received in batches. Nothing is packed, checked or computed.

     reed_bare_bus plant GROUP PORT CORE
     reed_bare_bus controller GROUP PORT CORE CYCLES PERIOD_US      prints the durations of its cycles, ns */
#define _GNU_SOURCE
#include <arpa/inet.h>
#include <errno.h>
#include <poll.h>
#include <sched.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/socket.h>
#include <time.h>
#include <unistd.h>

enum { kSync = 162, kState = 170, kWrench = 186, kCommand = 202, kStates = 5, kAnswers = kStates + 1, kBatch = 32 };

static int out_fd, in_fd;
static in_port_t own_port;
static char bytes[kBatch][512];
static struct iovec vector[kBatch];
static struct sockaddr_in source[kBatch];
static struct mmsghdr message[kBatch];

static int64_t now_ns(void) {
  struct timespec t;
  clock_gettime(CLOCK_MONOTONIC, &t);
  return (int64_t)t.tv_sec * 1000000000 + t.tv_nsec;
}

static void need(int ok, const char* what) {
  if (ok) return;
  perror(what);
  exit(3);
}

static void open_bus(const char* group, int port) {
  struct sockaddr_in to = {.sin_family = AF_INET, .sin_port = htons((uint16_t)port)};
  struct sockaddr_in own = {.sin_family = AF_INET};
  struct in_addr loopback = {htonl(INADDR_LOOPBACK)};
  struct ip_mreq join;
  socklen_t size = sizeof own;
  int zero = 0, one = 1, i;
  need(inet_pton(AF_INET, group, &to.sin_addr) == 1, "group");
  own.sin_addr = loopback;
  out_fd = socket(AF_INET, SOCK_DGRAM, 0);
  in_fd = socket(AF_INET, SOCK_DGRAM, 0);
  setsockopt(out_fd, IPPROTO_IP, IP_MULTICAST_IF, &loopback, sizeof loopback);
  setsockopt(out_fd, IPPROTO_IP, IP_MULTICAST_TTL, &zero, sizeof zero);
  need(bind(out_fd, (struct sockaddr*)&own, sizeof own) == 0, "bind");
  need(connect(out_fd, (struct sockaddr*)&to, sizeof to) == 0, "connect");
  getsockname(out_fd, (struct sockaddr*)&own, &size);
  own_port = own.sin_port;
  setsockopt(in_fd, SOL_SOCKET, SO_REUSEADDR, &one, sizeof one);
  setsockopt(in_fd, SOL_SOCKET, SO_REUSEPORT, &one, sizeof one);
  need(bind(in_fd, (struct sockaddr*)&to, sizeof to) == 0, "bind");
  join.imr_multiaddr = to.sin_addr;
  join.imr_interface = loopback;
  need(setsockopt(in_fd, IPPROTO_IP, IP_ADD_MEMBERSHIP, &join, sizeof join) == 0, "multicast on loopback");
  for (i = 0; i < kBatch; ++i) {
    vector[i].iov_base = bytes[i];
    message[i].msg_hdr.msg_iov = &vector[i];
    message[i].msg_hdr.msg_iovlen = 1;
  }
}

static void send_frames(const int* sizes, int count) {
  static const char frame[512];
  struct mmsghdr batch[kBatch];
  struct iovec part[kBatch];
  int i;
  memset(batch, 0, sizeof batch);
  for (i = 0; i < count; ++i) {
    part[i].iov_base = (void*)(uintptr_t)frame;
    part[i].iov_len = (size_t)sizes[i];
    batch[i].msg_hdr.msg_iov = &part[i];
    batch[i].msg_hdr.msg_iovlen = 1;
  }
  sendmmsg(out_fd, batch, (unsigned)count, 0);
}

/* Takes what is there, without the own frames; the size of the last one taken is in *last. */
static int take(int* last) {
  int i, got, count = 0;
  for (i = 0; i < kBatch; ++i) {
    vector[i].iov_len = sizeof bytes[i];
    message[i].msg_hdr.msg_name = &source[i];
    message[i].msg_hdr.msg_namelen = sizeof source[i];
  }
  got = recvmmsg(in_fd, message, kBatch, MSG_DONTWAIT, NULL);
  for (i = 0; i < got; ++i) {
    if (source[i].sin_port == own_port) continue;
    *last = (int)message[i].msg_len;
    ++count;
  }
  return count;
}

/* Waits for `wanted` frames, 100 ms at most. */
static int wait_for(int wanted, int* last) {
  struct timespec patience = {0, 100000000};
  struct pollfd entry = {.fd = in_fd, .events = POLLIN};
  int count = take(last);
  while (count < wanted && ppoll(&entry, 1, &patience, NULL) > 0) count += take(last);
  return count;
}

static void plant(void) {
  const int answer[kAnswers] = {kState, kState, kState, kState, kState, kWrench};
  int last = 0;
  while (getppid() != 1)
    if (wait_for(1, &last) > 0 && last == kSync) send_frames(answer, kAnswers);
}

static void controller(int cycles, int64_t period_ns) {
  const int sync = kSync, command = kCommand;
  int64_t deadline = now_ns() + period_ns, start;
  int k, last;
  for (k = 0; k < cycles; ++k, deadline += period_ns) {
    const struct timespec at = {deadline / 1000000000, deadline % 1000000000};
    while (clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &at, NULL) == EINTR) {
    }
    start = now_ns();
    send_frames(&sync, 1);
    if (wait_for(kAnswers, &last) < kAnswers) continue;
    send_frames(&command, 1);
    printf("%lld\n", (long long)(now_ns() - start));
  }
}

int main(int argc, char** argv) {
  const struct sched_param priority = {.sched_priority = 80};
  cpu_set_t core;
  if (argc < 5) return 2;
  open_bus(argv[2], atoi(argv[3]));
  mlockall(MCL_CURRENT | MCL_FUTURE);
  if (atoi(argv[4]) >= 0) {
    CPU_ZERO(&core);
    CPU_SET((size_t)atoi(argv[4]), &core);
    sched_setaffinity(0, sizeof core, &core);
  }
  sched_setscheduler(0, SCHED_FIFO, &priority);
  if (strcmp(argv[1], "plant") == 0) {
    plant();
  } else if (argc > 6) {
    controller(atoi(argv[5]), 1000LL * atoi(argv[6]));
  }
  return 0;
}
