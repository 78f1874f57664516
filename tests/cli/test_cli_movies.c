/* SPDX-License-Identifier: Apache-2.0
 *
 * --movie makes one frame for each time. All frames share one camera. ffmpeg reads the frames again. Other tests use a small
 * program named ffmpeg, which counts the frames. */
#include <dirent.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "expect.h"
#include "program.h"
#include "scratch.h"
#include "virtual_display.h"
#include "vtk_shim.h"

enum { n_frames = 4 };

#define RUN_MOVIE(movie, ...)                                                                                       \
  (scratch_write_text("cycle.csv", "0,0\n1,1\n"),                                                                   \
   RUN_FINE("mark", scratch_path("in.vtu"), "--valve", "mitral", "--half-thickness", "0.3", "--cycle",              \
            scratch_path("cycle.csv"), "--movie", scratch_path(movie), "--frame-rate", "5", "--movie-view", "side", \
            "--quiet", __VA_ARGS__))

/* Checks that TMPDIR, which is the scratch folder, has no frame. */
static void expect_no_frames(void) {
  const char *place = getenv("TMPDIR");
  DIR *folder = opendir(place);
  assert_non_null(folder);
  for (const struct dirent *entry = readdir(folder); entry; entry = readdir(folder))
    if (strncmp(entry->d_name, "riis-", 5) == 0 || strncmp(entry->d_name, ".riis-", 6) == 0)
      fail_msg("%s is left", entry->d_name);
  closedir(folder);
}

static void use_scratch_for_frames(void) {
  char place[4096];
  assert_non_null(realpath(scratch_path("."), place));
  setenv("TMPDIR", place, 1);
}

/* Writes a shell script named ffmpeg with these lines. */
static char *put_program(const char *lines) {
  char path[8192], place[4096];
  mkdir(scratch_path("bin"), 0700);
  scratch_write_text("bin/ffmpeg", lines);
  assert_int_equal(chmod(scratch_path("bin/ffmpeg"), 0700), 0);
  assert_non_null(realpath(scratch_path("bin"), place));
  char *before = strdup(getenv("PATH"));
  snprintf(path, sizeof path, "%s:%s", place, before);
  setenv("PATH", path, 1);
  return before;
}

static void restore_path(char *before) {
  setenv("PATH", before, 1);
  free(before);
}

static void expect_whole_picture(const char *name) {
  int width = 0, height = 0, n_colours = 0, n_coloured[2] = {0, 0};
  assert_int_equal(shim_read_png(scratch_path(name), &width, &height, &n_colours, n_coloured), 1);
  assert_true(width == 1600 && height == 800);
  assert_true(n_coloured[0] > 20000 && n_coloured[1] > 20000);
}

/* Uses a fake encoder that copies its frames. */
TEST(test_frames) {
  static const char *const names[n_frames] = {"f/frame_000000.png", "f/frame_000001.png", "f/frame_000002.png",
                                              "f/frame_000003.png"};
  use_scratch_for_frames();
  char *before = put_program(
      "#!/bin/sh\nfor word; do last=$word; done\nfor word; do case $word in *frame_*) folder=${word%/*};; esac; done\n"
      "cp -r \"$folder\" \"${last%/*}/f\" && echo \"$*\" > \"$last\"\n");
  RUN_MOVIE("a.mp4", "--times", "0,0.3,0.6,1", "--picture", scratch_path("first.png"), "--view", "side");
  restore_path(before);
  for (int i = 0; i < n_frames; ++i) expect_whole_picture(names[i]);
  assert_false(scratch_exists("f/frame_000004.png"));
  char *words = scratch_read(scratch_path("a.mp4"), NULL);
  assert_non_null(strstr(words, "-framerate 5 "));
  free(words);
  expect_no_frames();
  expect_whole_picture("first.png");
  /* The outline of the mesh and the scale bar do not move: the lowest rows of all frames are the same. */
  int size[2];
  unsigned char *first = shim_read_pixels(scratch_path(names[0]), &size[0], &size[1]);
  for (int i = 1; i < n_frames; ++i) {
    unsigned char *next = shim_read_pixels(scratch_path(names[i]), &size[0], &size[1]);
    assert_memory_equal(first, next, (size_t)(3 * 1600) * 60);
    assert_true(memcmp(first, next, (size_t)(3 * 1600) * 800) != 0);
    free(next);
  }
  free(first);
}

/* If the encoder fails, the refusal quotes its last lines. The movie and the frames are removed. */
TEST(test_failing_encoder) {
  use_scratch_for_frames();
  scratch_write_text("kept.gif", "before");
  char *before = put_program("#!/bin/sh\necho first >&2\necho 'no such encoder' >&2\nexit 7\n");
  scratch_write_text("cycle.csv", "0,0\n1,1\n");
  RUN_REFUSED(1, "kept.gif: the movie cannot be made: ffmpeg ends with status 7: no such encoder", "mark",
              scratch_path("in.vtu"), "--valve", "mitral", "--half-thickness", "0.3", "--cycle",
              scratch_path("cycle.csv"), "--times", "0,1", "--movie", scratch_path("kept.gif"), "--output",
              scratch_path("s.pvd"), "--quiet");
  restore_path(before);
  expect_no_frames();
  char *text = scratch_read(scratch_path("kept.gif"), NULL);
  assert_string_equal(text, "before");
  free(text);
  assert_true(scratch_exists("s/s_0001.vtu"));
}

static int n_frames_there(void) {
  char command[8192];
  int n = 0;
  snprintf(command, sizeof command, "ls '%s'/riis-*/frame_*.png 2>/dev/null | wc -l", getenv("TMPDIR"));
  FILE *output = popen(command, "r");
  assert_int_equal(fscanf(output, "%d", &n), 1);
  pclose(output);
  return n;
}

/* After Ctrl-C between two frames there is no movie and no frame. The meshes written so far stay. */
TEST(test_interruption) {
  use_scratch_for_frames();
  char *before = put_program("#!/bin/sh\nexit 0\n");
  scratch_write_text("cycle.csv", "0,0\n1,1\n");
  const pid_t process =
      start_program("mark", scratch_path("in.vtu"), "--valve", "mitral", "--half-thickness", "0.3", "--cycle",
                    scratch_path("cycle.csv"), "--times", "0:1:0.001", "--movie", scratch_path("never.mp4"),
                    "--picture-size", "400x300", "--output", scratch_path("cut.pvd"), "--quiet", NULL);
  for (int n_tries = 0; n_frames_there() < 2 && n_tries < 3000; ++n_tries) usleep(20000);
  kill(process, SIGINT);
  finish_program(process);
  restore_path(before);
  assert_int_equal(program_exit_code, 128 + SIGINT);
  assert_int_equal(n_frames_there(), 0);
  expect_no_frames();
  assert_false(scratch_exists("never.mp4"));
  assert_true(scratch_exists("cut.pvd") && scratch_exists("cut/cut_0001.vtu"));
}

/* Expects that ffmpeg decodes this width, height and number of frames, as it prints them. */
static void expect_movie(const char *name, const char *expected) {
  char command[1024], words[64] = "";
  snprintf(command, sizeof command,
           "ffprobe -v error -count_frames -select_streams v:0 -show_entries stream=width,height,nb_read_frames "
           "-of csv=p=0 '%s'",
           scratch_path(name));
  FILE *output = popen(command, "r");
  assert_non_null(fgets(words, sizeof words, output));
  assert_int_equal(pclose(output), 0);
  words[strcspn(words, "\n")] = 0;
  assert_string_equal(words, expected);
  expect_no_frames();
}

/* If the real ffmpeg is installed, it decodes as many frames as there are times. A .gif is 800 pixels wide, unless the user gives
 * a size. The movies are small or short, because an emulator needs minutes for a large frame. */
TEST(test_movie) {
  if (system("command -v ffmpeg ffprobe >/dev/null") != 0) skip();
  use_scratch_for_frames();
  RUN_MOVIE("b.mp4", "--times", "0,0.3,0.6,1", "--picture-size", "400x300");
  expect_movie("b.mp4", "400,300,4");
  RUN_MOVIE("b.gif", "--times", "0,1");
  expect_movie("b.gif", "800,400,2");
}

static int make_mitral_box(void **state) { return make_box_of(state, (double[3]){-3, -3, -2}, (double[3]){3, 3, 2}); }

int main(int argc, char **argv) {
  (void)argc;
  enter_virtual_display(argv);
  return run_cases(make_mitral_box, scratch_teardown);
}
