// SPDX-License-Identifier: Apache-2.0
// Measures the errors of the paper's three methods to compute a distance (section 4.1, "Performance evaluation"). One leaflet
// belongs to the aortic valve and one to the mitral valve. The true distances of the points are known. Prints a table. Fails if
// an error is larger than its promised bound.
//   argv[1]  a JSON file for the table and further results
//   argv[2]  the number of points per leaflet
#include <riis/riis.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <fstream>
#include <functional>
#include <limits>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>
#include <vector>

#include "accuracy/ground_truth.hpp"
#include "accuracy/methods.hpp"

namespace {

using namespace riis::accuracy;
using nlohmann::json;
using Clock = std::chrono::steady_clock;

// The tolerance of the triangles that check true distances. This tolerance gives about two million triangles per leaflet.
constexpr double fine_tolerance = 5e-5;
constexpr std::uint64_t seed = 1;
// For this fraction of the points, sampling may have an error above the tolerance.
constexpr double sampling_share = 1e-3;

// Returns a quantile: the given fraction of the values lies below it. The values must ascend.
double quantile(const std::vector<double> &ascending, double share) {
  const auto n = static_cast<double>(ascending.size());
  return ascending[std::min(ascending.size() - 1, static_cast<std::size_t>(share * n))];
}

// Counts the values in bins of equal width on a logarithmic scale. Values below the first bin are counted in "below".
json histogram_of(const std::vector<double> &values, double lowest_power, double highest_power, double bins_per_power) {
  std::vector<std::int64_t> counts(static_cast<std::size_t>((highest_power - lowest_power) * bins_per_power));
  std::int64_t below = 0, above = 0;
  for (const double value : values) {
    const double bin = value > 0 ? (std::log10(value) - lowest_power) * bins_per_power : -1;
    if (bin < 0)
      ++below;
    else if (bin >= static_cast<double>(counts.size()))
      ++above;
    else
      ++counts[static_cast<std::size_t>(bin)];
  }
  return {{"lowest_power_of_10", lowest_power},
          {"bins_per_power", bins_per_power},
          {"counts", counts},
          {"below", below},
          {"above", above}};
}

json summary_of(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return {{"median", quantile(values, 0.5)}, {"p95", quantile(values, 0.95)}, {"max", values.back()}};
}

// Returns microseconds per point. Takes the fastest of three passes, because other work on the machine makes times longer.
double mean_microseconds(const MeasuredSurface &surface, const TruePoints &points) {
  double least = std::numeric_limits<double>::infinity(), sum = 0;
  for (int pass = 0; pass < 3; ++pass) {
    const Clock::time_point start = Clock::now();
    for (std::size_t i = 0; i < points.n(); ++i) sum += surface.distance(points.point(i));
    least = std::min(least, std::chrono::duration<double, std::micro>(Clock::now() - start).count());
  }
  if (!std::isfinite(sum)) throw std::runtime_error("a distance is not finite");
  return least / static_cast<double>(points.n());
}

json measure(const MeasuredSurface &surface, const TruePoints &points, double tolerance) {
  std::vector<double> errors, microseconds;
  double least = std::numeric_limits<double>::infinity(), most = -least;
  std::int64_t n_over = 0;
  for (std::size_t i = 0; i < points.n(); ++i) {
    const Clock::time_point start = Clock::now();
    const double distance = surface.distance(points.point(i));
    microseconds.push_back(std::chrono::duration<double, std::micro>(Clock::now() - start).count());
    const double error = (distance - points.distance[i]) / half_thickness;
    least = std::min(least, error);
    most = std::max(most, error);
    errors.push_back(std::abs(error));
    // An error counts only if it exceeds the tolerance by more than 1e-9, because coordinates are rounded.
    n_over += std::abs(error) > tolerance + 1e-9;
  }
  json result = summary_of(errors);
  result["least_signed"] = least;
  result["most_signed"] = most;
  result["n_points"] = points.n();
  result["n_over_tolerance"] = n_over;
  result["share_over_tolerance"] = static_cast<double>(n_over) / static_cast<double>(points.n());
  result["histogram"] = histogram_of(errors, -12, 1, 10);
  result["microseconds"] = summary_of(microseconds);
  result["microseconds"]["mean"] = mean_microseconds(surface, points);
  result["microseconds"]["histogram"] = histogram_of(microseconds, -2, 5, 20);
  return result;
}

// Returns a message about the first promise that is broken, or "" if all promises are kept.
std::string broken_promise(const Setting &setting, const json &run) {
  for (const char *where : {"on_surface", "off_surface"}) {
    const double share = run.at(where).at("share_over_tolerance");
    const double allowed = setting.method == RIIS_MEASURE_TRIANGLES  ? 0
                           : setting.method == RIIS_MEASURE_SAMPLING ? sampling_share
                                                                     : 1;
    if (share > allowed)
      return std::string(name_of(setting.method)) + " " + setting.name + ", " + where + ": " +
             std::to_string(100 * share) + " % of the points are off by more than the tolerance";
  }
  return "";
}

void print(const char *label, const json &of) {
  const json &time = of.at("microseconds");
  std::printf(" %s %.2e | %.2e | %.2e | %.2f %% | %.2f |", label, of.at("median").get<double>(),
              of.at("p95").get<double>(), of.at("max").get<double>(), 100 * of.at("share_over_tolerance").get<double>(),
              time.at("mean").get<double>());
}

json study(const Leaflet &leaflet, std::size_t n_points, std::vector<std::string> &broken) {
  const riis::PatchSet patches = patches_of(leaflet);
  const GroundTruth truth = make_ground_truth(patches, {n_points, seed, fine_tolerance});
  std::printf(
      "\n%s valve, %s: %zu points on the smooth surface, %zu off it by %g to %g half thicknesses. Left out: %lld where "
      "the curvature radius is less than %g offsets, %lld to which another part is nearer. Checked with %lld "
      "triangles, "
      "within %g half thicknesses of the smooth surface: distances to them differ by at most %.2g.\n\n",
      leaflet.valve, leaflet.name, truth.on_surface.n(), truth.off_surface.n(),
      *std::min_element(offsets.begin(), offsets.end()), *std::max_element(offsets.begin(), offsets.end()),
      static_cast<long long>(truth.n_curved), 1 / largest_share_of_radius, static_cast<long long>(truth.n_nearer),
      static_cast<long long>(truth.n_fine_triangles), truth.fine_error, truth.most_from_fine);
  std::printf(
      "| method | tolerance | triangles, samples or patches | on it: median | 95 %% | largest | over | µs | off it: "
      "median | 95 %% | largest | over | µs |\n|---|---|---|---|---|---|---|---|---|---|---|---|---|\n");
  json runs = json::array();
  for (const Setting &setting : settings) {
    const MeasuredSurface surface(patches, setting.method, setting.tolerance);
    json run = {{"method", name_of(setting.method)},
                {"setting", setting.name},
                {"tolerance", setting.tolerance},
                {"size", surface.size()},
                {"on_surface", measure(surface, truth.on_surface, setting.tolerance)},
                {"off_surface", measure(surface, truth.off_surface, setting.tolerance)}};
    std::printf("| %s | %s | %lld |", name_of(setting.method), setting.name, static_cast<long long>(surface.size()));
    print("", run.at("on_surface"));
    print("", run.at("off_surface"));
    std::printf("\n");
    std::fflush(stdout);
    if (const std::string text = broken_promise(setting, run); !text.empty())
      broken.push_back(std::string(leaflet.name) + ", " + text);
    runs.push_back(run);
  }
  return {{"valve", leaflet.valve},
          {"leaflet", leaflet.name},
          {"truth",
           {{"n_on_surface", truth.on_surface.n()},
            {"n_off_surface", truth.off_surface.n()},
            {"offsets_half_thicknesses", offsets},
            {"largest_share_of_curvature_radius", largest_share_of_radius},
            {"n_left_out_curved", truth.n_curved},
            {"n_left_out_other_part_nearer", truth.n_nearer},
            {"n_fine_triangles", truth.n_fine_triangles},
            {"fine_error", truth.fine_error},
            {"most_from_fine", truth.most_from_fine}}},
          {"runs", runs}};
}

json machine() {
  std::string model = "unknown", line;
  std::ifstream cpuinfo("/proc/cpuinfo");
  while (std::getline(cpuinfo, line))
    if (line.rfind("model name", 0) == 0) {
      model = line.substr(std::min(line.size(), line.find(':') + 2));
      break;
    }
#if defined(__clang__)
  const char *compiler = __VERSION__;
#else
  const char *compiler = "gcc " __VERSION__;
#endif
  return {{"cpu", model},
          {"cores", std::thread::hardware_concurrency()},
          {"compiler", compiler},
          {"riis", riis_version_string()}};
}

int run(int argc, char **argv) {
  const long long n_points = argc > 2 ? std::strtoll(argv[2], nullptr, 10) : 20000;
  if (n_points < 100) {
    std::fprintf(stderr, "%s: %s is not a number of points, 100 or more\n", argv[0], argv[2]);
    return 2;
  }
  const json here = machine();
  std::printf(
      "Errors in half thicknesses (%g cm); µs a point by one thread. %s, %u cores; %s; random numbers from %llu.\n",
      half_thickness, here.at("cpu").get<std::string>().c_str(), here.at("cores").get<unsigned>(),
      here.at("compiler").get<std::string>().c_str(), static_cast<unsigned long long>(seed));
  std::vector<std::string> broken;
  json studies = json::array();
  for (const Leaflet &leaflet : leaflets) studies.push_back(study(leaflet, static_cast<std::size_t>(n_points), broken));
  if (argc > 1) {
    std::ofstream file(argv[1]);
    file << json{{"machine", here}, {"half_thickness", half_thickness}, {"seed", seed}, {"leaflets", studies}}.dump(1)
         << '\n';
    file.close();
    if (!file) {
      std::fprintf(stderr, "%s: cannot be written\n", argv[1]);
      return 1;
    }
  }
  for (const std::string &text : broken) std::fprintf(stderr, "NOT as promised: %s\n", text.c_str());
  return broken.empty() ? 0 : 1;
}

}  // namespace

int main(int argc, char **argv) {
  try {
    return run(argc, argv);
  } catch (const std::exception &error) {
    std::fprintf(stderr, "%s: %s\n", argv[0], error.what());
    return 1;
  }
}
