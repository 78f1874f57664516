/* SPDX-License-Identifier: Apache-2.0
 *
 * A written file is complete or does not exist. A failed write leaves the old file as it was, and leaves no other file. */
#include <errno.h>
#include <riis/riis_vtk.h>
#include <signal.h>
#include <stdint.h>
#include <stdlib.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include "expect.h"
#include "scratch.h"
#include "vtk_shim.h"

static riis_vtk_mesh *mesh;

static int make_mesh(void **state) {
  const double lower[3] = {0, 0, 0}, upper[3] = {1, 1, 1};
  scratch_setup(state);
  if (!shim_write_box(scratch_path("in.vtu"), SHIM_RAW, 12, lower, upper, 0)) return -1;
  return riis_vtk_mesh_read(scratch_path("in.vtu"), &mesh);
}

static int destroy_mesh(void **state) {
  riis_vtk_mesh_destroy(&mesh);
  return scratch_teardown(state);
}

static riis_surface *make_surface(void) {
  riis_valve *valve = NULL;
  riis_surface *surface = NULL;
  expect_fine(riis_valve_create("aortic", &valve));
  expect_fine(riis_surface_create(valve, NULL, &surface));
  riis_valve_destroy(&valve);
  return surface;
}

static void expect_content(const char *name, const char *expected) {
  char *bytes = scratch_read(scratch_path(name), NULL);
  assert_string_equal(bytes, expected);
  free(bytes);
}

TEST(test_places) {
  const int n_before = scratch_n_files();
  expect_refused(riis_vtk_mesh_write(mesh, scratch_path("no_folder/out.vtu")), RIIS_FILE_ERROR,
                 "No such file or directory");
  expect_refused(riis_vtk_mesh_write(mesh, scratch_path("out.vtk")), RIIS_FILE_ERROR, "must be .vtu");
  expect_refused(riis_vtk_mesh_write(mesh, "/dev/full"), RIIS_FILE_ERROR, "/dev/full: ");
  assert_int_equal(scratch_n_files(), n_before);
  assert_int_equal(mkdir(scratch_path("folder.vtu"), 0700), 0);
  expect_refused(riis_vtk_mesh_write(mesh, scratch_path("folder.vtu")), RIIS_FILE_ERROR, "is a directory");
  assert_int_equal(symlink("/dev/full", scratch_path("full.vtu")), 0);
  expect_refused(riis_vtk_mesh_write(mesh, scratch_path("full.vtu")), RIIS_FILE_ERROR, "is not a regular file");
  assert_int_equal(scratch_n_files(), n_before + 2);
  riis_surface *surface = make_surface();
  expect_refused(riis_vtk_surface_write(surface, scratch_path("no_folder/out.vtp")), RIIS_FILE_ERROR, "out.vtp");
  expect_refused(riis_vtk_surface_write(surface, scratch_path("out.stl")), RIIS_FILE_ERROR, "must be .vtp");
  assert_int_equal(scratch_n_files(), n_before + 2);
  riis_surface_destroy(&surface);
}

TEST(test_locked) {
  if (geteuid() == 0) skip(); /* root may write every file, so the test is skipped */
  assert_int_equal(mkdir(scratch_path("locked"), 0500), 0);
  expect_refused(riis_vtk_mesh_write(mesh, scratch_path("locked/out.vtu")), RIIS_FILE_ERROR, "Permission denied");
  scratch_write_text("locked.vtu", "kept");
  assert_int_equal(chmod(scratch_path("locked.vtu"), 0400), 0);
  expect_refused(riis_vtk_mesh_write(mesh, scratch_path("locked.vtu")), RIIS_FILE_ERROR, "Permission denied");
  expect_content("locked.vtu", "kept");
}

/* Writes while a file may have only n_bytes, as on a full disk. */
static riis_status write_in_little_room(rlim_t n_bytes, const char *name) {
  struct rlimit limit, small;
  getrlimit(RLIMIT_FSIZE, &limit);
  small = limit;
  small.rlim_cur = n_bytes;
  void (*handler)(int) = signal(SIGXFSZ, SIG_IGN);
  scratch_watch_output();
  setrlimit(RLIMIT_FSIZE, &small);
  const riis_status status = riis_vtk_mesh_write(mesh, scratch_path(name));
  setrlimit(RLIMIT_FSIZE, &limit);
  const long n_printed = scratch_end_watch();
  signal(SIGXFSZ, handler);
  assert_int_equal(n_printed, 0);
  return status;
}

TEST(test_full_disk) {
  scratch_write_text("kept.vtu", "what was there");
  expect_fine(riis_vtk_mesh_write(mesh, scratch_path("whole.vtu")));
  struct stat status;
  assert_int_equal(stat(scratch_path("whole.vtu"), &status), 0);
  const int n_before = scratch_n_files();
  const rlim_t size = (rlim_t)status.st_size;
  const rlim_t rooms[] = {0, 1, 1000, size / 3, size / 2, size - 20000, size - 100, size - 12, size - 1};
  for (size_t i = 0; i < sizeof rooms / sizeof rooms[0]; ++i) {
    expect_refused(write_in_little_room(rooms[i], "kept.vtu"), RIIS_FILE_ERROR, "kept.vtu: ");
    expect_content("kept.vtu", "what was there");
    assert_int_equal(scratch_n_files(), n_before);
  }
  expect_fine(write_in_little_room(size + 4096, "kept.vtu"));
  assert_int_equal(scratch_n_files(), n_before);
  int64_t n_points = 0;
  assert_int_equal(shim_read_points(scratch_path("kept.vtu"), &n_points, NULL, NULL, NULL), 1);
  assert_int_equal(n_points, 12 * 12 * 12);
}

/* If a link has the file's name, the write replaces the link's target and keeps the link. A file may also replace the file from
 * which it was read. */
TEST(test_links_and_sources) {
  scratch_write_text("target.vtu", "old");
  assert_int_equal(symlink("target.vtu", scratch_path("link.vtu")), 0);
  expect_fine(riis_vtk_mesh_write(mesh, scratch_path("link.vtu")));
  struct stat status;
  assert_int_equal(lstat(scratch_path("link.vtu"), &status), 0);
  assert_true(S_ISLNK(status.st_mode));
  assert_int_equal(lstat(scratch_path("target.vtu"), &status), 0);
  assert_true(S_ISREG(status.st_mode) && status.st_size > 10000);
  expect_fine(riis_vtk_mesh_write(mesh, scratch_path("in.vtu")));
  int64_t n_points = 0;
  assert_int_equal(shim_read_points(scratch_path("in.vtu"), &n_points, NULL, NULL, NULL), 1);
  assert_int_equal(n_points, 12 * 12 * 12);
}

/* If the link's target is missing, the write makes the target and keeps the link. Links that form a circle are an error. */
TEST(test_dangling_links) {
  struct stat status;
  assert_int_equal(mkdir(scratch_path("deep"), 0700), 0);
  assert_int_equal(symlink("deep/second.vtu", scratch_path("first.vtu")), 0);
  assert_int_equal(symlink("../made.vtu", scratch_path("deep/second.vtu")), 0);
  expect_fine(riis_vtk_mesh_write(mesh, scratch_path("first.vtu")));
  assert_int_equal(lstat(scratch_path("first.vtu"), &status), 0);
  assert_true(S_ISLNK(status.st_mode));
  assert_int_equal(lstat(scratch_path("deep/second.vtu"), &status), 0);
  assert_true(S_ISLNK(status.st_mode));
  assert_int_equal(lstat(scratch_path("made.vtu"), &status), 0);
  assert_true(S_ISREG(status.st_mode) && status.st_size > 10000);
  assert_int_equal(symlink("circle.vtu", scratch_path("circle.vtu")), 0);
  expect_refused(riis_vtk_mesh_write(mesh, scratch_path("circle.vtu")), RIIS_FILE_ERROR,
                 "circle.vtu: cannot be written");
  assert_int_equal(lstat(scratch_path("circle.vtu"), &status), 0);
  assert_true(S_ISLNK(status.st_mode));
}

TEST(test_permissions) {
  const mode_t mask = umask(0027);
  expect_fine(riis_vtk_mesh_write(mesh, scratch_path("mode.vtu")));
  umask(mask);
  struct stat status;
  assert_int_equal(stat(scratch_path("mode.vtu"), &status), 0);
  assert_int_equal(status.st_mode & 0777, 0640);
  /* A new file gets the permissions of the file that it replaces. */
  assert_int_equal(chmod(scratch_path("mode.vtu"), 0606), 0);
  expect_fine(riis_vtk_mesh_write(mesh, scratch_path("mode.vtu")));
  assert_int_equal(stat(scratch_path("mode.vtu"), &status), 0);
  assert_int_equal(status.st_mode & 0777, 0606);
}

/* During each call, VTK's output window and its warnings are silent. After the call, the caller's settings apply again. */
TEST(test_output_window) {
  riis_vtk_mesh *other = NULL;
  shim_watch_window();
  scratch_write_text("broken.vtu", "<VTKFile type=\"UnstructuredGrid\"><UnstructuredGrid>\n</VTKFile>\n");
  expect_refused(riis_vtk_mesh_read(scratch_path("broken.vtu"), &other), RIIS_FILE_ERROR, "broken.vtu");
  assert_int_equal(shim_n_messages(), 0);
  scratch_watch_output();
  shim_say_error();
  scratch_end_watch();
  assert_int_equal(shim_n_messages(), 1);
}

int main(void) { return run_cases(make_mesh, destroy_mesh); }
