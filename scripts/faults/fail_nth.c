// Preloaded library that fails the n-th call of one system function, or all from the n-th on.
//
//   GEM_FAIL_CALL    write, pwrite, fsync (and fdatasync), open, ftruncate, fallocate, rename, malloc
//   GEM_FAIL_NTH     the call that fails, from 1
//   GEM_FAIL_STAYS   1: all later calls fail too
//   GEM_FAIL_COUNT   file that gets the number of calls at the end of the process
//   GEM_FAIL_FOLDER  calls on files outside of this folder do not count (all but malloc)
#define _GNU_SOURCE
#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <stdarg.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/types.h>
#include <unistd.h>

void* __libc_malloc(size_t size);
void* __libc_calloc(size_t count, size_t size);
void* __libc_realloc(void* block, size_t size);

static atomic_long calls;
static long nth;
static int stays;
static const char* call;
static const char* folder;

__attribute__((constructor)) static void read_settings(void) {
  const char* number = getenv("GEM_FAIL_NTH");
  nth = number != NULL ? atol(number) : 0;
  stays = getenv("GEM_FAIL_STAYS") != NULL;
  folder = getenv("GEM_FAIL_FOLDER");
  call = getenv("GEM_FAIL_CALL");
}

__attribute__((destructor)) static void write_count(void) {
  const char* path = getenv("GEM_FAIL_COUNT");
  const long count = atomic_load(&calls);
  call = NULL;
  FILE* file = path != NULL ? fopen(path, "w") : NULL;
  if (file == NULL) return;
  fprintf(file, "%ld\n", count);
  fclose(file);
}

// Whether this call of `name` is to fail.
static int fails(const char* name) {
  if (call == NULL || strcmp(call, name) != 0) return 0;
  const long now = atomic_fetch_add(&calls, 1) + 1;
  return nth > 0 && (now == nth || (stays && now > nth));
}

static int inside(const char* path) { return folder == NULL || strncmp(path, folder, strlen(folder)) == 0; }

static int inside_of(int file) {
  if (call == NULL) return 0;
  char link[64], path[4096];
  snprintf(link, sizeof link, "/proc/self/fd/%d", file);
  const ssize_t size = readlink(link, path, sizeof path - 1);
  if (size < 0) return 0;
  path[size] = '\0';
  return inside(path);
}

static int fail(int why) {
  errno = why;
  return -1;
}

ssize_t write(int file, const void* data, size_t size) {
  static ssize_t (*real)(int, const void*, size_t);
  if (real == NULL) real = dlsym(RTLD_NEXT, "write");
  if (inside_of(file) && fails("write")) return fail(ENOSPC);
  return real(file, data, size);
}

ssize_t pwrite64(int file, const void* data, size_t size, off64_t at) {
  static ssize_t (*real)(int, const void*, size_t, off64_t);
  if (real == NULL) real = dlsym(RTLD_NEXT, "pwrite64");
  if (inside_of(file) && fails("pwrite")) return fail(EIO);
  return real(file, data, size, at);
}

ssize_t pwrite(int file, const void* data, size_t size, off_t at) { return pwrite64(file, data, size, at); }

int fsync(int file) {
  static int (*real)(int);
  if (real == NULL) real = dlsym(RTLD_NEXT, "fsync");
  if (inside_of(file) && fails("fsync")) return fail(EIO);
  return real(file);
}

int fdatasync(int file) {
  static int (*real)(int);
  if (real == NULL) real = dlsym(RTLD_NEXT, "fdatasync");
  if (inside_of(file) && fails("fsync")) return fail(EIO);
  return real(file);
}

int ftruncate64(int file, off64_t size) {
  static int (*real)(int, off64_t);
  if (real == NULL) real = dlsym(RTLD_NEXT, "ftruncate64");
  if (inside_of(file) && fails("ftruncate")) return fail(EIO);
  return real(file, size);
}

int ftruncate(int file, off_t size) { return ftruncate64(file, size); }

int fallocate64(int file, int mode, off64_t from, off64_t size) {
  static int (*real)(int, int, off64_t, off64_t);
  if (real == NULL) real = dlsym(RTLD_NEXT, "fallocate64");
  if (inside_of(file) && fails("fallocate")) return fail(ENOSPC);
  return real(file, mode, from, size);
}

int fallocate(int file, int mode, off_t from, off_t size) { return fallocate64(file, mode, from, size); }

int rename(const char* from, const char* to) {
  static int (*real)(const char*, const char*);
  if (real == NULL) real = dlsym(RTLD_NEXT, "rename");
  if (call != NULL && inside(from) && fails("rename")) return fail(EIO);
  return real(from, to);
}

int renameat2(int folder_from, const char* from, int folder_to, const char* to, unsigned flags) {
  static int (*real)(int, const char*, int, const char*, unsigned);
  if (real == NULL) real = dlsym(RTLD_NEXT, "renameat2");
  if (call != NULL && inside(from) && fails("rename")) return fail(EIO);
  return real(folder_from, from, folder_to, to, flags);
}

static int open_with(const char* path, int flags, mode_t mode) {
  static int (*real)(const char*, int, ...);
  if (real == NULL) real = dlsym(RTLD_NEXT, "open64");
  if (call != NULL && inside(path) && fails("open")) return fail(EIO);
  return real(path, flags, mode);
}

int open64(const char* path, int flags, ...) {
  va_list list;
  va_start(list, flags);
  const mode_t mode = va_arg(list, mode_t);
  va_end(list);
  return open_with(path, flags, mode);
}

int open(const char* path, int flags, ...) {
  va_list list;
  va_start(list, flags);
  const mode_t mode = va_arg(list, mode_t);
  va_end(list);
  return open_with(path, flags, mode);
}

void* malloc(size_t size) {
  if (fails("malloc")) {
    errno = ENOMEM;
    return NULL;
  }
  return __libc_malloc(size);
}

void* calloc(size_t count, size_t size) {
  if (fails("malloc")) {
    errno = ENOMEM;
    return NULL;
  }
  return __libc_calloc(count, size);
}

void* realloc(void* block, size_t size) {
  if (fails("malloc")) {
    errno = ENOMEM;
    return NULL;
  }
  return __libc_realloc(block, size);
}
