// SPDX-License-Identifier: Apache-2.0
// Tests flat ends of walls. The oracle is the generator, which knows where it cut the walls. Numbers of vessels, directions,
// leans, waves, units, caps and reversed triangles are random. A wall without ends or with faults is refused with the reason and
// the cure.
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <ios>  // before fail becomes a macro of CMocka
#include <map>
#include <string>
#include <vector>

#include "common/array_view.hpp"
#include "cut_tubes.hpp"
#include "program/base/refusal.hpp"
#include "program/patient/flat_ends.hpp"

namespace {

using namespace riis::program;
using namespace riis::tests;
using namespace riis;

void expect_text(const std::string &text, const std::vector<std::string> &parts) {
  for (const std::string &part : parts)
    expect(text.find(part) != std::string::npos, "\"" + text + "\" has \"" + part + "\"");
}

const std::string &file() {
  static const std::string path = "flat_ends_" + std::to_string(getpid()) + ".stl";
  return path;
}

const Placement as_it_is{{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}, 1, {}};

void write(const Triangles &triangles, random_source &random, Turned turned = Turned::none,
           const Placement &placement = as_it_is) {
  write_stl(file(), triangles, placement, turned, random);
}

// Returns the text of the refusal, or "" if the wall was read.
std::string refusal_of(const EndPoints &points = {}) {
  try {
    read_patient_wall(file(), points);
    return "";
  } catch (const Refusal &refusal) {
    return refusal.text;
  }
}

void expect_refused(const std::vector<std::string> &parts, const EndPoints &points = {}) {
  const std::string text = refusal_of(points);
  expect(!text.empty(), "the wall is refused with " + parts[0]);
  if (!text.empty()) expect_text(text, parts);
}

double volume_of(const PatientWall &wall) {
  double volume = 0;
  for (std::int64_t i = 0; i < wall.triangles.n(); ++i) {
    Vector3 p[3];
    for (std::size_t k = 0; k < 3; ++k) p[k] = wall.triangles.corner(i, k) - wall.triangles.points[0];
    volume += dot(p[0], cross(p[1], p[2])) / 6;
  }
  return volume;
}

// At each side, a triangle has exactly one neighbour, which runs along the side in the other direction.
void expect_closed(const PatientWall &wall) {
  std::map<std::pair<std::int64_t, std::int64_t>, int> sides;
  for (const Corners &corner : wall.triangles.corners)
    for (std::size_t k = 0; k < 3; ++k) ++sides[{corner[k], corner[(k + 1) % 3]}];
  for (const auto &[side, n] : sides) {
    const auto other = sides.find({side.second, side.first});
    if (n == 1 && other != sides.end()) continue;
    expect(false, "each side has one neighbour that runs the other way");
    return;
  }
}

void expect_ends(const PatientWall &wall, const CutVessels &vessels, const Placement &placement) {
  expect(wall.ends.size() == vessels.ends.size(),
         std::to_string(vessels.ends.size()) + " ends, " + std::to_string(wall.ends.size()) + " are found");
  const double unit = placement.scale;
  std::vector<char> is_found(vessels.ends.size(), 0);
  double before = 1e300;
  for (const FlatEnd &end : wall.ends) {
    expect(end.area <= before, "the largest end comes first");
    before = end.area;
    std::size_t nearest = 0;
    for (std::size_t i = 0; i < vessels.ends.size(); ++i)
      if (norm(placement.of(vessels.ends[i].centre) - end.centre) <
          norm(placement.of(vessels.ends[nearest].centre) - end.centre))
        nearest = i;
    const CutEnd &cut = vessels.ends[nearest];
    is_found[nearest] = 1;
    expect_near(norm(placement.of(cut.centre) - end.centre) / unit, 0, 0.02, "distance of the centre");
    expect_near(dot(placement.turned(cut.outward), end.outward), 1, 2e-5, "cosine of the normal");
    expect_near(end.area / (unit * unit), cut.area, 0.01 * cut.area, "area");
  }
  expect(std::count(is_found.begin(), is_found.end(), 0) == 0, "each end is found");
  std::vector<double> areas(wall.ends.size(), 0);
  for (std::int64_t i = 0; i < wall.triangles.n(); ++i) {
    if (view(wall.end_of)[i] < 0) continue;
    Vector3 p[3];
    for (std::size_t k = 0; k < 3; ++k) p[k] = wall.triangles.corner(i, k);
    view(areas)[view(wall.end_of)[i]] += 0.5 * norm(cross(p[1] - p[0], p[2] - p[0]));
  }
  for (std::size_t i = 0; i < areas.size(); ++i)
    expect_near(areas[i] / wall.ends[i].area, 1, 1e-9, "the triangles of an end over its area");
}

void random_vessels(random_source &random) {
  const int n = trials(30, 1000);
  int n_open = 0, n_some = 0, n_five = 0;
  for (int trial = 0; trial < n; ++trial) {
    here = "trial " + std::to_string(trial);
    const int n_ends = 2 + static_cast<int>(random_bits(&random) % 4);
    const auto cap = static_cast<Cap>(random_bits(&random) % 3);
    const double waves = trial % 3 == 0 ? 0 : random_between(&random, 0, 0.06);
    const CutVessels vessels = draw_vessels(random, n_ends, waves, cap);
    // A vessel of about 12 mm, in metres, centimetres or millimetres. The scanner's origin is up to a metre away.
    constexpr double units[3] = {1e-3, 0.1, 1};
    const double unit = units[random_bits(&random) % 3];
    const Placement placement = draw_placement(random, 12 * unit, random_between(&random, 0, 1100) * unit);
    const auto turned = static_cast<Turned>(random_bits(&random) % 3);
    write(vessels.triangles, random, turned, placement);
    try {
      const PatientWall wall = read_patient_wall(file());
      expect_ends(wall, vessels, placement);
      expect_closed(wall);
      const double cube = std::pow(placement.scale, 3);
      Triangles closed = vessels.triangles;
      if (cap != Cap::open) expect_near(wall.volume / cube, closed.volume(), 2e-4 * closed.volume(), "volume");
      expect_near(volume_of(wall) / wall.volume, 1, 1e-6, "volume of the triangles");
      const auto n_remarks = [&](const char *part) {
        return std::count_if(wall.remarks.begin(), wall.remarks.end(),
                             [&](const std::string &text) { return text.find(part) != std::string::npos; });
      };
      expect(n_remarks("is closed there by a flat end") == (cap == Cap::open ? n_ends : 0), "open ends are said");
      expect(n_remarks("all triangles face inwards") == (turned == Turned::all), "turned triangles are said");
      expect((n_remarks(" face inwards, and are turned outwards") > n_remarks("all triangles")) ==
                 (turned == Turned::some),
             "some turned triangles are said");
      for (const FlatEnd &end : wall.ends) expect(end.was_open == (cap == Cap::open), "an open end is known");
      n_open += cap == Cap::open;
      n_some += turned == Turned::some;
      n_five += n_ends == 5;
      // A valve stands in the first vessel, and blood comes from this vessel's end. If the flow is reversed, blood comes from
      // another end.
      for (const double way : {-1.0, 1.0}) {
        PatientWall named = wall;
        name_ends(named, placement.of(vessels.axes[0]), placement.turned(way * vessels.axes[0]));
        const auto inlet =
            std::find_if(named.ends.begin(), named.ends.end(), [](const FlatEnd &end) { return end.name == "inlet"; });
        expect(inlet != named.ends.end(), "there is an inlet");
        if (inlet == named.ends.end()) continue;
        const bool is_first = norm(placement.of(vessels.ends[0].centre) - inlet->centre) < 0.1 * placement.scale;
        expect(is_first == (way < 0), "the inlet is upstream");
      }
    } catch (const Refusal &refusal) {
      expect(false, "the wall is not refused by: " + refusal.text);
    }
  }
  here = "all trials";
  expect(is_short_test() || (n_open > 0 && n_some > 0 && n_five > 0),
         "open ends, turned triangles and five ends were met");
}

// A tube of radius 1 along z, from 0 to `length`. Its triangles face outwards. The ends lean by an angle whose tangent is `lean`.
// The caps are fans around the last two vertices.
Triangles tube(int n_around, int n_rings, double length, double lean = 0) {
  Triangles made;
  for (int j = 0; j <= n_rings; ++j)
    for (int i = 0; i < n_around; ++i) {
      const double turn = 2 * 3.14159265358979323846 * i / n_around, share = static_cast<double>(j) / n_rings;
      made.points.push_back({std::cos(turn), std::sin(turn), length * share + lean * (2 * share - 1) * std::cos(turn)});
    }
  const auto id = [&](int j, int i) { return static_cast<std::int64_t>(j * n_around + i % n_around); };
  for (int j = 0; j < n_rings; ++j)
    for (int i = 0; i < n_around; ++i) {
      made.corners.push_back({id(j, i), id(j, i + 1), id(j + 1, i + 1)});
      made.corners.push_back({id(j, i), id(j + 1, i + 1), id(j + 1, i)});
    }
  const auto lower = static_cast<std::int64_t>(made.points.size());
  made.points.push_back({0, 0, 0});
  made.points.push_back({0, 0, length});
  for (int i = 0; i < n_around; ++i) {
    made.corners.push_back({lower, id(0, i + 1), id(0, i)});
    made.corners.push_back({lower + 1, id(n_rings, i), id(n_rings, i + 1)});
  }
  return made;
}

void append(Triangles &triangles, const Triangles &other, double scale, const Vector3 &offset, bool turned = false) {
  const auto first = static_cast<std::int64_t>(triangles.points.size());
  for (const Vector3 &point : other.points) triangles.points.push_back(offset + scale * point);
  for (Corners corner : other.corners) {
    if (turned) std::swap(corner[1], corner[2]);
    triangles.corners.push_back({first + corner[0], first + corner[1], first + corner[2]});
  }
}

// A ball whose triangles meet in fans at its poles.
Triangles ball(int n) {
  Triangles made = tube(2 * n, n - 2, 1);
  for (std::size_t i = 0; i + 2 < made.points.size(); ++i) {
    const double up = 3.14159265358979323846 * (made.points[i][2] * (n - 2) + 1) / n;
    made.points[i] = {std::sin(up) * made.points[i][0], std::sin(up) * made.points[i][1], -std::cos(up)};
  }
  made.points[made.points.size() - 2] = {0, 0, -1};
  made.points[made.points.size() - 1] = {0, 0, 1};
  return made;
}

// A box whose sides are divided into squares.
Triangles box(int n, const Vector3 &sides) {
  Triangles made;
  for (std::size_t axis = 0; axis < 3; ++axis)
    for (int side = 0; side < 2; ++side)
      for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j) {
          const auto first = static_cast<std::int64_t>(made.points.size());
          for (int c = 0; c < 4; ++c) {
            Vector3 point{};
            point[axis] = side * sides[axis];
            point[(axis + 1) % 3] = sides[(axis + 1) % 3] * (i + (c == 1 || c == 2)) / n;
            point[(axis + 2) % 3] = sides[(axis + 2) % 3] * (j + (c >= 2)) / n;
            made.points.push_back(point);
          }
          const std::int64_t turn = side == 0 ? 2 : 0;
          made.corners.push_back({first, first + 1 + turn / 2, first + 2 - turn / 2});
          made.corners.push_back({first, first + 2 + turn / 2, first + 3 - turn / 2});
        }
  return made;
}

std::size_t n_ends(const EndPoints &points = {}) { return read_patient_wall(file(), points).ends.size(); }

void faults(random_source &random) {
  here = "faults";
  const Triangles whole = tube(40, 30, 6, 0.3);
  write(whole, random);
  expect(refusal_of().empty() && n_ends() == 2, "the tube has two ends");

  Triangles bad = whole;
  bad.corners.erase(bad.corners.begin() + 1000);
  write(bad, random);
  expect_refused({file() + ": the surface has a hole of 3 edges at ", ": close it", "Close Holes of MeshLab"});
  bad = whole;
  bad.corners.erase(bad.corners.begin() + 1520, bad.corners.begin() + 1560);
  bad.corners.erase(bad.corners.begin() + 700, bad.corners.begin() + 720);
  write(bad, random);
  expect_refused({"the surface has 2 holes, one of 42 edges at ", "is off its plane by ", "cut an open end flat"});

  bad = whole;
  append(bad, whole, 0.8, {3, 0, 0});
  write(bad, random);
  expect_refused(
      {"the surface has 2 pieces, the two largest of 2,480 around ", "Islands in the Segment Editor of 3D Slicer"});
  bad = whole;
  append(bad, whole, 0.8, {0, 0, 0.6}, true);
  write(bad, random);
  expect_refused(
      {"one lies within the other, like the two faces of a thick wall: export only the surface of the blood"});
  bad = whole;
  append(bad, ball(4), 0.05, {0, 0, 3});
  write(bad, random);
  expect(n_ends() == 2, "an island is left out");
  expect_text(read_patient_wall(file()).remarks[0], {"1 island of 48 triangles is left out"});

  bad = whole;
  bad.points.push_back({2, 0, 3});
  bad.corners.push_back({bad.corners[900][0], bad.corners[900][1], static_cast<std::int64_t>(bad.points.size()) - 1});
  write(bad, random);
  expect_refused({"1 edge has more than two triangles, such as the edge at ", "with 3: the surface touches itself",
                  "Repair non Manifold Edges of MeshLab"});
  bad = whole;
  bad.points[400] = bad.points[420];
  write(bad, random);
  expect_refused({"the surface touches itself at a vertex, ", "Repair non Manifold Vertices of MeshLab"});

  bad = whole;
  bad.corners.push_back(bad.corners[5]);
  write(bad, random);
  expect(n_ends() == 2, "a triangle in the file twice is counted once");
  expect_text(read_patient_wall(file()).remarks[0], {"1 triangle is in the file twice, and counted once"});

  // A strip with half a twist. The strip is widened, because a narrow strip would be ignored as an island.
  bad = Triangles();
  for (int i = 0; i < 40; ++i)
    for (const double side : {-0.4, 0.4}) {
      const double turn = 2 * 3.14159265358979323846 * i / 40, r = 1 + side * std::cos(turn / 2);
      bad.points.push_back({r * std::cos(turn), r * std::sin(turn), side * std::sin(turn / 2)});
    }
  for (std::int64_t i = 0; i < 40; ++i) {
    const std::int64_t next = i == 39 ? 0 : 2 * i + 2;
    const std::int64_t c = i == 39 ? next + 1 : next, d = i == 39 ? next : next + 1;
    bad.corners.push_back({2 * i, 2 * i + 1, d});
    bad.corners.push_back({2 * i, d, c});
  }
  write(bad, random);
  expect_refused({"the surface has only one side, like a Moebius strip"});

  // The file has vertices that rounding separated, and a triangle without area in a joint.
  bad = whole;
  bad.points.push_back(bad.points[500] + Vector3{2e-6, 0, 0});
  bad.corners[1000][0] =
      bad.corners[1000][0] == 500 ? static_cast<std::int64_t>(bad.points.size()) - 1 : bad.corners[1000][0];
  const Corners split = bad.corners[700];
  const auto middle = static_cast<std::int64_t>(bad.points.size());
  bad.points.push_back(
      0.5 * (bad.points[static_cast<std::size_t>(split[0])] + bad.points[static_cast<std::size_t>(split[1])]));
  bad.corners[700] = {split[0], middle, split[2]};
  bad.corners.push_back({middle, split[1], split[2]});
  bad.corners.push_back({split[0], split[1], middle});
  write(bad, random);
  expect(refusal_of().empty() && n_ends() == 2, "rounded vertices and a triangle without an area are repaired");
  bool is_said[2] = {false, false};
  for (const std::string &remark : read_patient_wall(file()).remarks) {
    is_said[0] |= remark.find("joined with a vertex less than ") != std::string::npos;
    is_said[1] |= remark.find("1 triangle has hardly any height, and is repaired") != std::string::npos;
  }
  expect(is_said[0] && is_said[1], "both repairs are said");
}

void unclear_ends(random_source &random) {
  here = "unclear ends";
  for (const int n : {4, 6, 9, 20, 60}) {
    write(ball(n), random, Turned::none, draw_placement(random, 10, 100));
    expect_refused({"no flat end is clear, but the blood needs two ends"});
  }
  // Each side of a box could be an end, so the user must name two.
  write(box(6, {1, 1.2, 3}), random);
  expect_refused({"no flat end is clear, but the blood needs two ends",
                  "choose flat parts by --inlet=X,Y,Z --outlet=X,Y,Z", "flat parts are ",
                  "with area 3.6 of 72 triangles"});
  EndPoints points{Vector3{0.5, 0.6, 0}, {Vector3{0.5, 0.6, 3}}};
  PatientWall wall = read_patient_wall(file(), points);
  expect(wall.ends.size() == 2 && wall.ends[0].name != wall.ends[1].name, "two points choose two sides");
  for (const FlatEnd &end : wall.ends) {
    expect_near(end.area, 1.2, 1e-6, "area of the chosen side");
    expect_near(end.centre[2], end.name == "inlet" ? 0 : 3, 1e-6, "place of the chosen side");
  }
  expect_refused({"--outlet=0.500,0.700,0.000: another point has already chosen the flat part at 0.500,0.600,0.000"},
                 {Vector3{0.5, 0.6, 0}, {Vector3{0.5, 0.7, 0}}});
  expect_refused({"0 flat parts are left for the inlet; also choose the inlet, by --inlet=X,Y,Z"},
                 {{}, {Vector3{0.5, 0.6, 0}}});

  // A vessel with a blind end.
  Triangles blind = tube(40, 30, 6);
  for (Vector3 &point : blind.points)
    if (point[2] > 5) {
      const double up = point[2] - 5, radius = std::sqrt(1 - std::min(1.0, up * up));
      point = {radius * point[0], radius * point[1], point[2]};
    }
  write(blind, random);
  expect_refused({"only the flat end at 0.000,0.000,0.000 is clear", "cut the vessels flat"});
  expect_refused({"--outlet=0.000,1.000,3.000: no flat part of " + file() + " is there; flat parts are "},
                 {Vector3{0, 0, 0}, {Vector3{0, 1, 3}}});

  // A vessel's wall with a thickness has an inner and an outer surface. Flat rings join the two surfaces.
  Triangles thick = tube(40, 30, 6), inner = tube(40, 30, 6);
  thick.corners.resize(thick.corners.size() - 80);
  inner.corners.resize(inner.corners.size() - 80);
  const auto n = static_cast<std::int64_t>(thick.points.size());
  for (Vector3 &point : inner.points) point = {0.8 * point[0], 0.8 * point[1], point[2]};
  append(thick, inner, 1, {}, true);
  for (std::int64_t i = 0; i < 40; ++i)
    for (const std::int64_t ring : {std::int64_t{0}, std::int64_t{30}}) {
      const std::int64_t a = 40 * ring + i, b = 40 * ring + (i + 1) % 40;
      Corners one{a, b, n + b}, two{a, n + b, n + a};
      if (ring == 0) std::swap(one[1], one[2]), std::swap(two[1], two[2]);
      thick.corners.push_back(one);
      thick.corners.push_back(two);
    }
  write(thick, random);
  expect_refused({"a flat part is a ring, so this wall has a thickness: export the surface of the blood instead"});
}

// The wall bulges and has a flat place. A flat place meets the wall at an angle that grows with its size. Below 30 degrees the
// place belongs to the wall, and above 55 degrees it is an end. Between these angles, the place is an end only if the user says
// so.
void flat_places(random_source &random) {
  const auto bulge = [](const Vector3 &x) {
    return std::min(std::hypot(x[1], x[2]) - 1, norm(x - Vector3{0, 0, 1}) - 1.7);
  };
  for (const double degrees : {20.0, 42.0, 75.0}) {
    here = "a flat place at " + std::to_string(degrees) + " degrees";
    Triangles made = surface_of(bulge, {-6.03, -6.02, -6.01}, 12.1, 80);
    cut(made, {4, 0, 0}, {1, 0, 0}, 3, Cap::fan, random);
    cut(made, {-4, 0, 0}, unit_vector({-1, 0.5, 0}), 3, Cap::rings, random);
    const double height = 1 + 1.7 * std::cos(degrees * 3.14159265358979323846 / 180);
    const CutEnd place = cut(made, {0, 0, height}, {0, 0, 1}, 2, Cap::rings, random);
    write(made, random);
    expect(refusal_of().empty() && n_ends() == (degrees > 55 ? 3U : 2U), "it is an end only if it is sharp");
    const EndPoints points{Vector3{4, 0, 0}, {Vector3{-4, 0, 0}, place.centre}};
    const std::string text = refusal_of(points);
    expect(degrees < 30 || (text.empty() && n_ends(points) == 3), "it is an end if a point says so" + text);
  }
}

void single_cases(random_source &random) {
  here = "single cases";
  const Triangles whole = tube(40, 30, 6, 0.3);
  write(whole, random);
  PatientWall wall = read_patient_wall(file());
  try {
    name_ends(wall, {0, 3, 3}, {0, 0, 1});
    expect(false, "a valve outside the wall is refused");
  } catch (const Refusal &refusal) {
    expect_text(refusal.text,
                {file() + ": the valve's centre, 0.000,3.000,3.000, lies outside the wall", "units or axes"});
  }
  name_ends(wall, {0, 0, 3}, {0, 0.2, 1});
  for (const FlatEnd &end : wall.ends) expect((end.name == "inlet") == (end.centre[2] < 3), "the inlet is below");
  PatientWall small = wall;
  scale_wall(small, 0.01);
  expect_near(small.volume / wall.volume, 1e-6, 1e-12, "volume in another unit");
  write_wall(small, file());
  const PatientWall again = read_patient_wall(file());
  expect_near(again.volume / small.volume, 1, 1e-5, "volume of the written wall");
  expect_near(again.area / small.area, 1, 1e-5, "area of the written wall");
  expect(again.ends.size() == 2 && again.remarks.empty(), "the written wall needs no repair");
  try {
    write_wall(wall, "no_folder/wall.stl");
    expect(false, "a folder that does not exist is refused");
  } catch (const Refusal &refusal) {
    expect_text(refusal.text, {"no_folder/wall.stl: cannot be written: No such file or directory"});
  }
}

}  // namespace

int main() {
  random_source random = random_start("test_flat_ends");
  faults(random);
  unclear_ends(random);
  flat_places(random);
  single_cases(random);
  random_vessels(random);
  std::remove(file().c_str());
  return n_faults == 0 ? 0 : 1;
}
