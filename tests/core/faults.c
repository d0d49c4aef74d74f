/* Let the n-th call that changes something below a folder fail, or find out how many there are.

   FAULT_UNDER the folder, FAULT_AT which call (1 is the first), FAULT_ERRNO how, FAULT_CALL which kind of call
   (empty: any), FAULT_LOG a file to which each call is told by name. */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

static int calls = 0;

static int fails(const char *call, const char *path) {
    const char *under = getenv("FAULT_UNDER"), *only = getenv("FAULT_CALL"), *log = getenv("FAULT_LOG");
    if (!under || !path || strncmp(path, under, strlen(under)) != 0) return 0;
    if (only && *only && strcmp(only, call) != 0) return 0;
    calls++;
    if (log) {
        int (*real_open)(const char *, int, ...) = dlsym(RTLD_NEXT, "open");
        ssize_t (*real_write)(int, const void *, size_t) = dlsym(RTLD_NEXT, "write");
        int told = real_open(log, O_WRONLY | O_CREAT | O_APPEND, 0600);
        real_write(told, call, strlen(call));
        real_write(told, "\n", 1);
        close(told);
    }
    const char *at = getenv("FAULT_AT"), *number = getenv("FAULT_ERRNO");
    if (!at || atoi(at) != calls) return 0;
    errno = number ? atoi(number) : EIO;
    return 1;
}

static const char *path_of(int fd, char *room) {
    char link[64];
    snprintf(link, sizeof link, "/proc/self/fd/%d", fd);
    ssize_t length = readlink(link, room, PATH_MAX - 1);
    if (length < 0) return NULL;
    room[length] = 0;
    return room;
}

#define MODE(flags, last) \
    mode_t mode = 0; \
    if ((flags) & O_CREAT) { va_list more; va_start(more, last); mode = va_arg(more, mode_t); va_end(more); }

#define OPEN(name) \
    int name(const char *path, int flags, ...) { \
        MODE(flags, flags) \
        int (*real)(const char *, int, ...) = dlsym(RTLD_NEXT, #name); \
        if ((flags & (O_WRONLY | O_RDWR | O_CREAT)) && fails("open", path)) return -1; \
        return real(path, flags, mode); \
    }
OPEN(open)
OPEN(open64)

ssize_t write(int fd, const void *from, size_t size) {
    char room[PATH_MAX];
    ssize_t (*real)(int, const void *, size_t) = dlsym(RTLD_NEXT, "write");
    return fails("write", path_of(fd, room)) ? -1 : real(fd, from, size);
}
int fsync(int fd) {
    char room[PATH_MAX];
    int (*real)(int) = dlsym(RTLD_NEXT, "fsync");
    return fails("fsync", path_of(fd, room)) ? -1 : real(fd);
}
int rename(const char *from, const char *to) {
    int (*real)(const char *, const char *) = dlsym(RTLD_NEXT, "rename");
    return fails("rename", to) ? -1 : real(from, to);
}
int renameat2(int a, const char *from, int b, const char *to, unsigned flags) {
    int (*real)(int, const char *, int, const char *, unsigned) = dlsym(RTLD_NEXT, "renameat2");
    return fails("rename", to) ? -1 : real(a, from, b, to, flags);
}
int mkdir(const char *path, mode_t mode) {
    int (*real)(const char *, mode_t) = dlsym(RTLD_NEXT, "mkdir");
    return fails("mkdir", path) ? -1 : real(path, mode);
}
int link(const char *from, const char *to) {
    int (*real)(const char *, const char *) = dlsym(RTLD_NEXT, "link");
    return fails("link", to) ? -1 : real(from, to);
}
int linkat(int a, const char *from, int b, const char *to, int flags) {
    int (*real)(int, const char *, int, const char *, int) = dlsym(RTLD_NEXT, "linkat");
    return fails("link", to) ? -1 : real(a, from, b, to, flags);
}
int chmod(const char *path, mode_t mode) {
    int (*real)(const char *, mode_t) = dlsym(RTLD_NEXT, "chmod");
    return fails("chmod", path) ? -1 : real(path, mode);
}
