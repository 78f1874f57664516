// SPDX-License-Identifier: Apache-2.0
// In: frames, as files in a folder of their own. Out: a movie, by the program ffmpeg.
#pragma once

#include <cstddef>
#include <string>

namespace riis::program {

// Refuses a movie of another kind than .mp4 and .gif, and one on a machine without ffmpeg. Does nothing for "".
void check_movie(const std::string &path);

class Movie {
 public:
  // Makes a temporary folder, which goes with the object.
  Movie(const std::string &path, double frame_rate);
  ~Movie();
  Movie(const Movie &) = delete;
  Movie &operator=(const Movie &) = delete;

  // Returns the path of the next frame, a .png file for the caller to write.
  std::string next_frame();
  // Makes the movie of the frames. Afterwards it is complete or as it was before.
  void encode() const;

 private:
  std::string path_, folder_;
  double frame_rate_;
  std::size_t n_frames_ = 0;
};

}  // namespace riis::program
