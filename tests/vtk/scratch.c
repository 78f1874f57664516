/* SPDX-License-Identifier: Apache-2.0 */
#include "scratch.h"

#include <dirent.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

static char folder[64];
static int saved_stdout = -1, saved_stderr = -1, watch_file = -1;

static void give_up(const char *what) {
  perror(what);
  exit(1);
}

int scratch_setup(void **state) {
  (void)state;
  strcpy(folder, "scratch-XXXXXX");
  if (!mkdtemp(folder)) give_up("mkdtemp");
  return 0;
}

static DIR *open_folder(const char *path) {
  DIR *files = opendir(path);
  if (!files) give_up(path);
  return files;
}

static int is_entry(const struct dirent *entry) {
  return strcmp(entry->d_name, ".") != 0 && strcmp(entry->d_name, "..") != 0;
}

static void remove_folder(const char *path) {
  DIR *files = open_folder(path);
  for (struct dirent *entry; (entry = readdir(files));) {
    if (!is_entry(entry)) continue;
    char name[1024];
    snprintf(name, sizeof name, "%s/%s", path, entry->d_name);
    struct stat status;
    if (lstat(name, &status) == 0 && S_ISDIR(status.st_mode)) {
      chmod(name, 0700);
      remove_folder(name);
    } else {
      unlink(name);
    }
  }
  closedir(files);
  rmdir(path);
}

int scratch_teardown(void **state) {
  (void)state;
  /* After a failed assertion, the file still contains the output with CMocka's report. scratch_end_watch prints it. */
  scratch_end_watch();
  remove_folder(folder);
  return 0;
}

const char *scratch_path(const char *name) {
  static char paths[16][512];
  static int next = 0;
  char *path = paths[next++ % 16];
  snprintf(path, sizeof paths[0], "%s/%s", folder, name);
  return path;
}

void scratch_write(const char *name, const void *bytes, size_t n_bytes) {
  FILE *file = fopen(scratch_path(name), "wb");
  if (!file || fwrite(bytes, 1, n_bytes, file) != n_bytes || fclose(file) != 0) give_up(name);
}

void scratch_write_text(const char *name, const char *text) { scratch_write(name, text, strlen(text)); }

char *scratch_read(const char *path, size_t *n_bytes) {
  FILE *file = fopen(path, "rb");
  struct stat status;
  if (!file || fstat(fileno(file), &status) != 0) give_up(path);
  const size_t size = (size_t)status.st_size;
  char *bytes = malloc(size + 1);
  if (!bytes || fread(bytes, 1, size, file) != size) give_up(path);
  fclose(file);
  bytes[size] = 0;
  if (n_bytes) *n_bytes = size;
  return bytes;
}

int scratch_is_same(const char *a, const char *b) {
  size_t size[2] = {0, 0};
  char *bytes[2] = {scratch_read(scratch_path(a), &size[0]), scratch_read(scratch_path(b), &size[1])};
  const int is_same = size[0] == size[1] && memcmp(bytes[0], bytes[1], size[0]) == 0;
  free(bytes[0]);
  free(bytes[1]);
  return is_same;
}

int scratch_n_files(void) {
  DIR *files = open_folder(folder);
  int n = 0;
  for (struct dirent *entry; (entry = readdir(files));) n += is_entry(entry);
  closedir(files);
  return n;
}

int scratch_exists(const char *name) { return access(scratch_path(name), F_OK) == 0; }

void scratch_watch_output(void) {
  fflush(stdout);
  fflush(stderr);
  char name[] = "watched-XXXXXX";
  watch_file = mkstemp(name);
  if (watch_file < 0) give_up("mkstemp");
  unlink(name);
  saved_stdout = dup(STDOUT_FILENO);
  saved_stderr = dup(STDERR_FILENO);
  dup2(watch_file, STDOUT_FILENO);
  dup2(watch_file, STDERR_FILENO);
}

long scratch_end_watch(void) {
  if (watch_file < 0) return 0;
  fflush(stdout);
  fflush(stderr);
  dup2(saved_stdout, STDOUT_FILENO);
  dup2(saved_stderr, STDERR_FILENO);
  close(saved_stdout);
  close(saved_stderr);
  struct stat status;
  if (fstat(watch_file, &status) != 0) give_up("fstat");
  char text[2048];
  const ssize_t n = pread(watch_file, text, sizeof text - 1, 0);
  if (n > 0) {
    text[n] = 0;
    fprintf(stderr, "printed: %s\n", text);
  }
  close(watch_file);
  watch_file = -1;
  return (long)status.st_size;
}
