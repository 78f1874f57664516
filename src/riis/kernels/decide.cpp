// SPDX-License-Identifier: Apache-2.0
// Computations in double precision for eight triangles at a time. The decision kernel repeats geometry/point_triangle.cpp
// operation by operation, so every lane gives the same bits as that function. This file also makes the triangles' frames for the
// filter. This file is compiled for each instruction set, always without fused multiplications and additions.
#include "kernels/lanes.hpp"
#include "kernels/table.hpp"

namespace riis {
namespace {

struct Doubles3 {
  Doubles x, y, z;
};

RIIS_INLINE Doubles3 as_point(const Doubles (&xyz)[3]) { return {xyz[0], xyz[1], xyz[2]}; }

// Gathers a point from each of eight addresses.
template <class Address>
RIIS_INLINE Doubles3 gather_point(const Address &address) {
  Doubles xyz[1][3];
  gather_points(address, xyz);
  return as_point(xyz[0]);
}

// The corners of eight triangles.
struct Corners {
  Doubles3 a, b, c;
};
template <class Address>
RIIS_INLINE Corners gather_corners(const Address &address) {
  Doubles xyz[3][3];
  gather_points(address, xyz);
  return {as_point(xyz[0]), as_point(xyz[1]), as_point(xyz[2])};
}

RIIS_INLINE Doubles3 operator+(Doubles3 a, Doubles3 b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
RIIS_INLINE Doubles3 operator-(Doubles3 a, Doubles3 b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
RIIS_INLINE Doubles3 operator*(Doubles s, Doubles3 a) { return {s * a.x, s * a.y, s * a.z}; }
RIIS_INLINE Doubles dot(Doubles3 a, Doubles3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
RIIS_INLINE Doubles3 cross(Doubles3 a, Doubles3 b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
RIIS_INLINE Doubles3 choose(Doubles::Mask where, Doubles3 yes, Doubles3 no) {
  return {choose(where, yes.x, no.x), choose(where, yes.y, no.y), choose(where, yes.z, no.z)};
}
RIIS_INLINE Doubles magnitude(Doubles a) {
  Doubles r;
  for (int i = 0; i < Doubles::n_registers; ++i)
    r.part[i] = (DoubleRegister)((LongRegister)a.part[i] & (INT64_MAX - LongRegister{}));
  return r;
}
RIIS_INLINE Doubles root(Doubles a) {
  count(&Counts::operations, Doubles::n);
  Doubles r;
  for (int i = 0; i < Doubles::n_registers; ++i) {
#if defined(__AVX512F__)
    r.part[i] = (DoubleRegister)_mm512_sqrt_pd((__m512d)a.part[i]);
#elif defined(__AVX2__)
    r.part[i] = (DoubleRegister)_mm256_sqrt_pd((__m256d)a.part[i]);
#elif defined(RIIS_SSE2)
    r.part[i] = (DoubleRegister)_mm_sqrt_pd((__m128d)a.part[i]);
#elif defined(RIIS_NEON)
    r.part[i] = (DoubleRegister)vsqrtq_f64((float64x2_t)a.part[i]);
#else
    for (int j = 0; j < Doubles::per_register; ++j) r.part[i][j] = __builtin_sqrt(a.part[i][j]);
#endif
  }
  return r;
}

// Returns 1 / sqrt(a) with an error of a few units in the last place. `a` must be a normal positive number. The last bits depend
// on the instruction set, so no result of a caller may depend on these bits.
RIIS_INLINE Doubles inverse_root(Doubles a) {
#if defined(__AVX512F__)
  // The estimate has 14 correct bits. Each step of Newton's method doubles the number of correct bits. Two steps take less time
  // than a root and a division.
  count(&Counts::operations, Doubles::n);
  Doubles r{{(DoubleRegister)_mm512_rsqrt14_pd((__m512d)a.part[0])}};
  const Doubles half = Doubles::all(0.5) * a;
  for (int i = 0; i < 2; ++i) r = r * (Doubles::all(1.5) - half * r * r);
  return r;
#else
  return Doubles::all(1) / root(a);
#endif
}

struct Weights {
  Doubles b, c;
};

RIIS_INLINE Weights plane_weights(Doubles3 r, Doubles3 ab, Doubles3 ac, Doubles3 n, Doubles inverse_nn) {
  return {dot(cross(r, ac), n) * inverse_nn, dot(cross(ab, r), n) * inverse_nn};
}

RIIS_INLINE Doubles::Mask inside(Weights w) {
  const Doubles zero = Doubles::all(0);
  return both(both(w.b >= zero, w.c >= zero), w.b + w.c <= Doubles::all(1));
}

// If the edge has no length, the parameter is 0, as in the scalar code.
RIIS_INLINE Doubles segment_parameter(Doubles3 r, Doubles3 edge) {
  return least(greatest(dot(r, edge) / dot(edge, edge), Doubles::all(0)), Doubles::all(1));
}

// The closest points on eight triangles. If a caller reads only `distance_sq`, the compiler leaves out the other members.
struct ClosestPoints {
  Doubles distance_sq;
  Doubles3 point, weights;
};

template <bool wants_point>
RIIS_INLINE ClosestPoints closest_points(Doubles3 p, const Corners &corners) {
  const Doubles3 a = corners.a, b = corners.b, c = corners.c;
  const Doubles3 ab = b - a, ac = c - a, bc = c - b, ap = p - a, bp = p - b;
  const Doubles t_ab = segment_parameter(ap, ab), t_ac = segment_parameter(ap, ac), t_bc = segment_parameter(bp, bc);
  const Doubles zero = Doubles::all(0), one = Doubles::all(1);
  ClosestPoints best{Doubles::all(__builtin_inf()), {zero, zero, zero}, {zero, zero, zero}};
  const auto offer = [&](Doubles3 point, Doubles3 weights, Doubles::Mask where) RIIS_LAMBDA {
    const Doubles3 difference = p - point;
    const Doubles distance_sq = dot(difference, difference);
    if constexpr (!wants_point) {
      best.distance_sq = choose(where, least(distance_sq, best.distance_sq), best.distance_sq);
    } else {
      const Doubles::Mask is_better = both(where, distance_sq < best.distance_sq);
      best.distance_sq = choose(is_better, distance_sq, best.distance_sq);
      best.point = choose(is_better, point, best.point);
      best.weights = choose(is_better, weights, best.weights);
    }
  };
  const auto on_edge = [&](Doubles3 first, Doubles3 edge, Doubles3 last, Doubles t)
                           RIIS_LAMBDA { return choose(t == one, last, first + t * edge); };
  const Doubles::Mask everywhere = zero == zero;
  offer(on_edge(a, ab, b, t_ab), {one - t_ab, t_ab, zero}, everywhere);
  offer(on_edge(b, bc, c, t_bc), {zero, one - t_bc, t_bc}, everywhere);
  offer(on_edge(a, ac, c, t_ac), {one - t_ac, zero, t_ac}, everywhere);

  const Doubles3 n = cross(ab, ac);
  const Doubles inverse_nn = one / dot(n, n);
  Weights w = plane_weights(ap, ab, ac, n, inverse_nn);
  const Doubles::Mask has_foot = inside(w);
  Doubles::Mask active = has_foot;
  for (int repeat = 0; repeat < 6 && any(active); ++repeat) {
    const Weights rest = plane_weights(ap - (w.b * ab + w.c * ac), ab, ac, n, inverse_nn);
    const Weights refined{w.b + rest.b, w.c + rest.c};
    active = both(active, inside(refined));
    w = {choose(active, refined.b, w.b), choose(active, refined.c, w.c)};
    active = both(active, magnitude(rest.b) + magnitude(rest.c) > Doubles::all(0x1p-50));
  }
  offer(a + (w.b * ab + w.c * ac), {one - (w.b + w.c), w.b, w.c}, has_foot);
  return best;
}

void decide(int32_t n, const int32_t *point, const int32_t *triangle, const double *points, const double *corners,
            double *distance_sq) {
  for (int32_t first = 0; first < n; first += Doubles::n) {
    const int32_t *of_point = point + first, *of_triangle = triangle + first;
    int32_t last_points[Doubles::n], last_triangles[Doubles::n];
    if (first + Doubles::n > n) {
      for (int lane = 0; lane < Doubles::n; ++lane) {
        const int32_t pair = first + lane < n ? first + lane : first;
        last_points[lane] = point[pair];
        last_triangles[lane] = triangle[pair];
      }
      of_point = last_points;
      of_triangle = last_triangles;
    }
    const Corners of_lanes =
        gather_corners([&](int lane) RIIS_LAMBDA { return corners + int64_t{9} * of_triangle[lane]; });
    const Doubles3 p = gather_point([&](int lane) RIIS_LAMBDA { return points + int64_t{3} * of_point[lane]; });
    const Doubles answers = closest_points<false>(p, of_lanes).distance_sq;
    __builtin_memcpy(distance_sq + first, answers.part, sizeof answers.part);
  }
}

void locate(const PointsAndTriangles &pairs, PointsOnTriangles &located) {
  const Corners corners = gather_corners([&](int lane) RIIS_LAMBDA { return pairs.corners[lane]; });
  const Doubles3 point = {Doubles::load(pairs.point[0]), Doubles::load(pairs.point[1]), Doubles::load(pairs.point[2])};
  const ClosestPoints closest = closest_points<true>(point, corners);
  const auto store = [](Doubles3 v, double(*to)[pairs_at_once]) RIIS_LAMBDA {
    v.x.store(to[0]);
    v.y.store(to[1]);
    v.z.store(to[2]);
  };
  closest.distance_sq.store(located.distance_sq);
  store(closest.point, located.point);
  store(closest.weights, located.barycentric);
  const Doubles zero = Doubles::all(0);
  located.at_border =
      bits(closest.weights.x == zero) | bits(closest.weights.y == zero) | bits(closest.weights.z == zero);
}

void mix_at_vertices(const VertexNumbers *numbers, const int64_t *const *vertex, const PointsOnTriangles &located,
                     VertexNumbers *mixed) {
  const auto numbers_of = [&](int64_t id) RIIS_LAMBDA { return Doubles::load(numbers[id].number); };
#pragma GCC unroll 8
  for (int lane = 0; lane < pairs_at_once; ++lane) {
    const int64_t *const id = vertex[lane];
    const auto weight = [&](int k) RIIS_LAMBDA { return Doubles::all(located.barycentric[k][lane]); };
    const Doubles mean = weight(0) * numbers_of(id[0]) + weight(1) * numbers_of(id[1]) + weight(2) * numbers_of(id[2]);
    mean.store(mixed[lane].number);
  }
}

void differentiate(const PointsAndTriangles &pairs, const PointsOnTriangles &located,
                   const double (&distance)[pairs_at_once], const int64_t *const *vertex, const double *const *rates,
                   int64_t n_directions, int32_t n_points, double *derivatives) {
  const auto vector = [&](const double(&from)[3][pairs_at_once]) RIIS_LAMBDA {
    return Doubles3{Doubles::load(from[0]), Doubles::load(from[1]), Doubles::load(from[2])};
  };
  const Doubles zero = Doubles::all(0), one = Doubles::all(1);
  const Doubles3 away = vector(pairs.point) - vector(located.point);
  const Doubles size = Doubles::load(distance);
  const Doubles::Mask is_away = size > zero;
  // The unit vectors from the points to the surface.
  const Doubles3 unit = choose(is_away, (Doubles::all(-1) / choose(is_away, size, one)) * away, {zero, zero, zero});
  // The unit vectors, multiplied by the weights of the three vertices.
  alignas(64) double weighted[3][3][pairs_at_once];
  for (int k = 0; k < 3; ++k) {
    const Doubles weight = Doubles::load(located.barycentric[k]);
    (weight * unit.x).store(weighted[k][0]);
    (weight * unit.y).store(weighted[k][1]);
    (weight * unit.z).store(weighted[k][2]);
  }
  // This loop takes one point at a time, because it would take longer to gather the rates of eight points.
  for (int32_t lane = 0; lane < n_points; ++lane) {
    const int64_t a = 3 * vertex[lane][0], b = 3 * vertex[lane][1], c = 3 * vertex[lane][2];
    const auto part = [&](int k, const double *rate) RIIS_LAMBDA {
      return weighted[k][0][lane] * rate[0] + weighted[k][1][lane] * rate[1] + weighted[k][2][lane] * rate[2];
    };
    for (int64_t i = 0; i < n_directions; ++i)
      *derivatives++ = part(0, rates[i] + a) + part(1, rates[i] + b) + part(2, rates[i] + c);
  }
}

void find_sides(const PointsAndTriangles &pairs, const PointsOnTriangles &located,
                const double (&normal)[3][pairs_at_once], int32_t *side) {
  const auto vector = [&](const double(&from)[3][pairs_at_once]) RIIS_LAMBDA {
    return Doubles3{Doubles::load(from[0]), Doubles::load(from[1]), Doubles::load(from[2])};
  };
  const Doubles height = dot(vector(pairs.point) - vector(located.point), vector(normal)), zero = Doubles::all(0);
  const uint32_t above = bits(height > zero), below = bits(height < zero);
  for (int lane = 0; lane < pairs_at_once; ++lane)
    side[lane] = static_cast<int32_t>(above >> lane & 1) - static_cast<int32_t>(below >> lane & 1);
}

// A point in one register. The fourth lane is unused.
typedef double Point __attribute__((vector_size(32)));

void take_corners(const double *vertices, const int64_t *vertex_id, int64_t n, double *corners, double *lower,
                  double *upper) {
  Point least_of = Point{} + __builtin_inf(), greatest_of = -least_of;
  const auto take = [&](int64_t i, int64_t size) RIIS_LAMBDA {
    const double *const from = vertices + 3 * vertex_id[i];
    // Reads only three numbers, because the vertex may be the last one of the array.
    const Point p = {from[0], from[1], from[2], 0};
    __builtin_memcpy(corners + 3 * i, &p, static_cast<__SIZE_TYPE__>(size));
    least_of = p < least_of ? p : least_of;
    greatest_of = greatest_of < p ? p : greatest_of;
  };
  // Each store also writes the fourth lane, which the next corner overwrites. The last corner is stored without the fourth lane.
  for (int64_t i = 0; i + 1 < 3 * n; ++i) take(i, sizeof(Point));
  take(3 * n - 1, 3 * sizeof *corners);
  for (int c = 0; c < 3; ++c) lower[c] = least_of[c], upper[c] = greatest_of[c];
}

// The corners of up to eight triangles, looked up by the ids of their vertices. Lanes without a triangle repeat the first
// triangle.
RIIS_INLINE Corners corners_by_id(const double *vertices, const int64_t *vertex_id, int32_t n) {
  const auto corner = [&](int k) RIIS_LAMBDA {
    return gather_point([&](int lane) RIIS_LAMBDA { return vertices + 3 * vertex_id[(lane < n ? 3 * lane : 0) + k]; });
  };
  return {corner(0), corner(1), corner(2)};
}

void place_points(const PlacedBy &by, const double *points, int64_t n, double *placed) {
  Point columns[8];
  const double *const from[8] = {by.of_image[0], by.of_image[1], by.of_image[2], by.offset_of_image,
                                 by.rotation[0], by.rotation[1], by.rotation[2], by.translation};
  for (int k = 0; k < 8; ++k) __builtin_memcpy(&columns[k], from[k], sizeof columns[k]);
  const auto place = [&](int64_t i, int64_t size) RIIS_LAMBDA {
    const double *const p = points + 3 * i;
    const Point image = p[0] * columns[0] + p[1] * columns[1] + p[2] * columns[2] + columns[3];
    const Point at = by.scale * (image[0] * columns[4] + image[1] * columns[5] + image[2] * columns[6]) + columns[7];
    __builtin_memcpy(placed + 3 * i, &at, static_cast<__SIZE_TYPE__>(size));
  };
  // Each store also writes the fourth lane, which the next point overwrites. The last point is stored without the fourth lane.
  for (int64_t i = 0; i + 1 < n; ++i) place(i, sizeof(Point));
  if (n > 0) place(n - 1, 3 * sizeof *placed);
}

bool have_area(const double *vertices, const int64_t *vertex_id, int32_t n, double shift) {
  const auto [a, b, c] = corners_by_id(vertices, vertex_id, n);
  const Doubles3 ab = b - a, ac = c - a, twice_area = cross(ab, ac);
  const Doubles size = dot(ab, ab) + dot(ac, ac);
  return !any(
      opposite(both(dot(twice_area, twice_area) > (Doubles::all(4e-23) * size + Doubles::all(shift * shift)) * size,
                    size > Doubles::all(1e-119))));
}

void measure_triangles(const double *vertices, const int64_t *vertex_id, int32_t n, TriangleMeasures &measures) {
  const auto [a, b, c] = corners_by_id(vertices, vertex_id, n);
  const Doubles3 ab = b - a, ac = c - a, bc = c - b, twice_area = cross(ab, ac);
  const Doubles one = Doubles::all(1), longest = root(greatest(greatest(dot(ab, ab), dot(bc, bc)), dot(ac, ac)));
  const Doubles3 scaled = cross((one / longest) * ab, (one / longest) * ac);
  const Doubles3 normal = (one / root(dot(scaled, scaled))) * scaled;
  normal.x.store(measures.normal[0]);
  normal.y.store(measures.normal[1]);
  normal.z.store(measures.normal[2]);
  root(dot(twice_area, twice_area)).store(measures.twice_area);
  dot(ab, ac).store(measures.product_at_a);
  dot(bc, a - b).store(measures.product_at_b);
}

void frame_group(const PlainFrame &frame, const double *corners, const int32_t *triangle, int32_t n,
                 GroupCorners &framed) {
  // Takes only as many triangles at a time as one register holds, so that the triangles' addresses also stay in registers.
  constexpr int at_once = Doubles::per_register;
  const DoubleRegister scale = frame.scale - DoubleRegister{};
  for (int from = 0; from < triangles_per_group; from += at_once) {
    const double *of_lane[at_once];
    // Lanes without a triangle repeat the first triangle.
    for (int lane = 0; lane < at_once; ++lane)
      of_lane[lane] = corners + int64_t{9} * triangle[from + lane < n ? from + lane : 0];
#pragma GCC unroll 9
    for (int c = 0; c < 9; ++c)
      *reinterpret_cast<Doubles::InMemory *>(framed.xyz[c] + from) =
          scale * (Doubles::gather_register(of_lane, c) - frame.centre[c % 3]);
  }
}

typedef float HalfRegister __attribute__((vector_size(register_bytes / 2)));

// Converts numbers to double precision. GCC's own conversion would convert each half of the register alone, and then join the
// halves.
RIIS_INLINE DoubleRegister widened(HalfRegister x) {
#if defined(__AVX512F__)
  return (DoubleRegister)_mm512_cvtps_pd((__m256)x);
#elif defined(__AVX2__)
  return (DoubleRegister)_mm256_cvtps_pd((__m128)x);
#else
  return __builtin_convertvector(x, DoubleRegister);
#endif
}

RIIS_INLINE void put(Doubles x, float *to) {
  for (int i = 0; i < Doubles::n_registers; ++i) {
    const HalfRegister single = __builtin_convertvector(x.part[i], HalfRegister);
    __builtin_memcpy(to + i * Doubles::per_register, &single, sizeof single);
  }
}

RIIS_INLINE void put(Doubles3 v, float (*to)[triangles_per_group], int from) {
  put(v.x, to[0] + from);
  put(v.y, to[1] + from);
  put(v.z, to[2] + from);
}

// Stores an axis in single precision, and an origin that gives `middle` the coordinate 0. The origin is computed for the rounded
// axis, so that the rounding error of a coordinate is proportional to the distance from `middle`.
RIIS_INLINE void put_axis(Doubles3 axis, Doubles3 middle, float (*to)[triangles_per_group], float *origin, int from) {
  put(axis, to, from);
  const auto rounded = [](Doubles x) RIIS_LAMBDA {
    for (DoubleRegister &part : x.part) part = widened(__builtin_convertvector(part, HalfRegister));
    return x;
  };
  put(Doubles::all(0) - dot(middle, Doubles3{rounded(axis.x), rounded(axis.y), rounded(axis.z)}), origin + from);
}

// The unit vector and the length of a vector. If the vector has no direction, the length is 0, and `unit` is a vector that the
// caller passes.
struct Direction {
  Doubles3 unit;
  Doubles length;
};

RIIS_INLINE Direction direction(Doubles3 v, Doubles3 otherwise) {
  const Doubles square = dot(v, v);
  const Doubles::Mask has_one = square > Doubles::all(1e-60);
  const Doubles inverse = inverse_root(choose(has_one, square, Doubles::all(1)));
  return {choose(has_one, inverse * v, otherwise), choose(has_one, square * inverse, Doubles::all(0))};
}

constexpr int halves = triangles_per_group / Doubles::n;

// Lowers a lower bound by slightly more than the largest rounding error of single precision. The result is therefore a lower
// bound even for numbers that were rounded to single precision.
RIIS_INLINE float round_down(double x) {
  const double unit = (x < 0 ? -x : x) * 0x1p-22 + 0x1p-120;
  return static_cast<float>(x - unit);
}

void frame_leaf(const PlainFrame &frame, const double *xyz, Leaf &leaf, float *lower, float *upper) {
  // The centre is subtracted from three registers at a time. These registers hold x, y, z of the first node, then of the second,
  // up to the eighth.
  constexpr int n_in_turn = 3;
  alignas(64) double turn[n_in_turn * Doubles::n];
  for (int i = 0; i < n_in_turn * Doubles::n; ++i) turn[i] = frame.centre[i % 3];
  const Doubles scale = Doubles::all(frame.scale), low = Doubles::all(-2), high = Doubles::all(2);
  Doubles centre[n_in_turn];
  for (int j = 0; j < n_in_turn; ++j) centre[j] = Doubles::load(turn + j * Doubles::n);
  alignas(64) float framed[3 * nodes_per_leaf];
  for (int k = 0; k < 3 * nodes_per_leaf; k += n_in_turn * Doubles::n)
    for (int j = 0; j < n_in_turn; ++j) {
      const Doubles x = Doubles::load_unaligned(xyz + k + j * Doubles::n);
      put(least(greatest(scale * (x - centre[j]), low), high), framed + k + j * Doubles::n);
    }
  for (int i = 0; i < nodes_per_leaf; ++i) {
    leaf.x[i] = framed[3 * i];
    leaf.y[i] = framed[3 * i + 1];
    leaf.z[i] = framed[3 * i + 2];
  }
  const Floats zero = Floats::all(0);
  Floats least_of[4] = {zero, zero, zero, zero}, opposite_of_greatest[4] = {zero, zero, zero, zero};
  const float *const of_axis[3] = {leaf.x, leaf.y, leaf.z};
  for (int i = 0; i < 3; ++i) {
    const Floats first = Floats::load(of_axis[i]), last = Floats::load(of_axis[i] + Floats::n);
    least_of[i] = least(first, last);
    opposite_of_greatest[i] = zero - greatest(first, last);
  }
  float least_lane[4], negated_greatest[4];
  least_lanes(least_of, least_lane);
  least_lanes(opposite_of_greatest, negated_greatest);
  for (int i = 0; i < 3; ++i) {
    lower[i] = least_lane[i];
    upper[i] = 0 - negated_greatest[i];
  }
}

struct Floats3 {
  Floats x, y, z;
};
RIIS_INLINE Floats3 load3(const float (*from)[triangles_per_group]) {
  return {Floats::load(from[0]), Floats::load(from[1]), Floats::load(from[2])};
}
RIIS_INLINE Floats dot(Floats3 a, Floats3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

RIIS_INLINE double sum_of(Doubles x) {
  alignas(64) double numbers[Doubles::n];
  x.store(numbers);
  double sum = 0;
  for (int i = 0; i < Doubles::n; ++i) sum += numbers[i];
  return sum;
}

// Scales vectors to length 1. Vectors of length 0 stay unchanged. Returns the lanes that have a length.
RIIS_INLINE Doubles::Mask normalize(Doubles3 &a) {
  const Doubles square = dot(a, a);
  const Doubles::Mask has_one = square > Doubles::all(1e-24);
  a = choose(has_one, inverse_root(choose(has_one, square, Doubles::all(1))) * a, a);
  return has_one;
}

struct Axes {
  alignas(64) double of[3][3][Doubles::n];
};

// Chooses the axes of eight groups: one across a group's triangles, one along its first edge, and one at right angles to both.
// Any three perpendicular axes would be correct, but the chosen axes give a small box. `across` is the sum of the triangles'
// normals. Each normal is as long as twice its triangle's area.
RIIS_INLINE void choose_axes(Doubles3 across, Doubles3 along, Axes &axes) {
  const Doubles zero = Doubles::all(0), one = Doubles::all(1);
  // Divides by the largest component, so that the squares do not underflow for small triangles.
  const Doubles largest = greatest(greatest(magnitude(across.x), magnitude(across.y)), magnitude(across.z));
  const Doubles::Mask has_largest = largest > Doubles::all(1e-300);
  const Doubles inverse = one / choose(has_largest, largest, one);
  across = choose(has_largest, inverse * across, {zero, zero, one});
  normalize(across);
  const auto take_across_away = [&](Doubles3 v) RIIS_LAMBDA { return v - dot(v, across) * across; };
  along = take_across_away(along);
  const Doubles::Mask has_edge = normalize(along);
  const Doubles::Mask steep = magnitude(across.x) < Doubles::all(0.6);
  along = choose(has_edge, along, {choose(steep, one, zero), choose(steep, zero, one), zero});
  // Rounding has left a component along `across`. If the edge is nearly parallel to `across`, this component is large. The loop
  // removes it.
  for (int i = 0; i < 2; ++i) {
    along = take_across_away(along);
    normalize(along);
  }
  const Doubles3 axis[3] = {across, along, cross(across, along)};
  for (int i = 0; i < 3; ++i) {
    axis[i].x.store(axes.of[i][0]);
    axis[i].y.store(axes.of[i][1]);
    axis[i].z.store(axes.of[i][2]);
  }
}

// Computes the bounds of a group from its corners. The corners are in the surface's frame and rounded to single precision.
RIIS_INLINE void bound_group(const float (*rounded)[triangles_per_group], GroupBounds &bounds) {
  const Floats3 corner[3] = {load3(rounded), load3(rounded + 3), load3(rounded + 6)};
  const Floats zero = Floats::all(0);
  // The box along the coordinate axes and the box along the group's own axes have three intervals each. An interval is stored as
  // its lower end and its negated upper end.
  Floats ends[3][4];
  const auto set_ends = [&](int at, Floats a, Floats b, Floats c) RIIS_LAMBDA {
    ends[at / 2][at % 2 * 2] = least(least(a, b), c);
    ends[at / 2][at % 2 * 2 + 1] = zero - greatest(greatest(a, b), c);
  };
  set_ends(0, corner[0].x, corner[1].x, corner[2].x);
  set_ends(1, corner[0].y, corner[1].y, corner[2].y);
  set_ends(2, corner[0].z, corner[1].z, corner[2].z);
  for (int i = 0; i < 3; ++i) {
    const float *axis = bounds.axis[i];
    const Floats3 direction = {Floats::all(axis[0]), Floats::all(axis[1]), Floats::all(axis[2])};
    set_ends(3 + i, dot(corner[0], direction), dot(corner[1], direction), dot(corner[2], direction));
  }
  float end[12];
  for (int i = 0; i < 3; ++i) least_lanes(ends[i], end + 4 * i);
  // Coordinates are at most 1, so the error of a dot product is at most 9 units of rounding.
  constexpr double products = 0x1p-20;
  for (int i = 0; i < 3; ++i) {
    bounds.lower[i] = round_down(end[2 * i]);
    bounds.upper[i] = -round_down(end[2 * i + 1]);
    bounds.from[i] = round_down(end[6 + 2 * i] - products);
    bounds.to[i] = -round_down(end[6 + 2 * i + 1] - products);
  }
  // Finds the corner nearest to the middle of the box. Lanes without a triangle repeat the first triangle.
  const auto middle = [&](int i) RIIS_LAMBDA { return Floats::all(0.5f * (end[2 * i] - end[2 * i + 1])); };
  const Floats3 to = {middle(0), middle(1), middle(2)};
  Floats distances[4];
  for (int k = 0; k < 3; ++k) {
    const Floats3 from_middle = {corner[k].x - to.x, corner[k].y - to.y, corner[k].z - to.z};
    distances[k] = dot(from_middle, from_middle);
  }
  distances[3] = distances[2];
  float nearest[4];
  least_lanes(distances, nearest);
  int k = nearest[1] < nearest[0] ? 1 : 0;
  k = nearest[2] < nearest[k] ? 2 : k;
  const int lane = __builtin_ctz(bits_at_most(distances[k], Floats::all(nearest[k])));
  for (int i = 0; i < 3; ++i) bounds.corner[i] = rounded[3 * k + i][lane];
}

// Makes the frames of a group's triangles, and rounds their corners. Also sums the triangles' normals, each as long as twice the
// triangle's area.
RIIS_INLINE void make_frames(const GroupCorners &corners, TriangleGroup &group,
                             float (&rounded)[9][triangles_per_group], double (&normal)[3]) {
  const Doubles zero = Doubles::all(0), one = Doubles::all(1);
  Doubles3 sum = {zero, zero, zero};
  for (int half = 0; half < halves; ++half) {
    const int from = half * Doubles::n;
    const auto corner = [&](int i) RIIS_LAMBDA {
      return Doubles3{Doubles::load(corners.xyz[3 * i] + from), Doubles::load(corners.xyz[3 * i + 1] + from),
                      Doubles::load(corners.xyz[3 * i + 2] + from)};
    };
    const Doubles3 a = corner(0), b = corner(1), c = corner(2), ac = c - a;
    put(a, rounded, from);
    put(b, rounded + 3, from);
    put(c, rounded + 6, from);
    const Direction e = direction(b - a, {one, zero, zero});
    const Doubles one_half = Doubles::all(0.5), half_ab = one_half * e.length;
    const Doubles3 middle = one_half * (a + b);
    put_axis(e.unit, middle, group.e, group.e_origin, from);
    put(half_ab, group.half_ab + from);
    // Returns the part of v at right angles to e. For a needle-shaped triangle, the rounded result still has a component along e.
    // A second call removes this component.
    const auto across = [&](Doubles3 v) RIIS_LAMBDA { return v - dot(v, e.unit) * e.unit; };
    // If the triangle's height is lost in rounding, `over` is only a rounding error, which may even be parallel to e.
    Doubles3 over = across(ac);
    const Doubles over_sq = dot(over, over);
    const Doubles::Mask has_height = both(over_sq > Doubles::all(0x1p-88) * dot(ac, ac), over_sq > Doubles::all(1e-59));
    if (any(opposite(has_height))) {
      const Doubles::Mask steep = magnitude(e.unit.x) < Doubles::all(0.6);
      const Doubles3 any_other = {choose(steep, one, zero), choose(steep, zero, one), zero};
      over = choose(has_height, over, direction(across(any_other), {zero, zero, one}).unit);
    }
    const Doubles3 f = direction(across(over), {zero, zero, one}).unit, g = cross(e.unit, f);
    const Doubles c_e = dot(ac, e.unit), c_f = dot(ac, f);
    put_axis(f, middle, group.f, group.f_origin, from);
    put_axis(g, middle, group.g, group.g_origin, from);
    sum = sum + (e.length * c_f) * g;
    // Stores the edge with the direction `along`. The edge leads from the coordinate `start` on ab to the third corner. The
    // coordinate on ab is 0 at the middle of ab.
    const auto put_edge = [&](Doubles start, Doubles3 along, float *unit_e, float *unit_f, float *to_middle,
                              float *side, float *half_length) RIIS_LAMBDA {
      const Direction edge = direction(along, {one, zero, zero});
      const Doubles half_edge = one_half * edge.length;
      put(edge.unit.x, unit_e + from);
      put(edge.unit.y, unit_f + from);
      put(zero - (start * edge.unit.x + half_edge), to_middle + from);
      put(half_ab * edge.unit.y, side + from);
      put(half_edge, half_length + from);
    };
    put_edge(zero - half_ab, {c_e, c_f, zero}, group.ac_e, group.ac_f, group.ac_middle, group.ac_side, group.half_ac);
    put_edge(half_ab, {c_e - e.length, c_f, zero}, group.bc_e, group.bc_f, group.bc_middle, group.bc_side,
             group.half_bc);
  }
  normal[0] = sum_of(sum.x), normal[1] = sum_of(sum.y), normal[2] = sum_of(sum.z);
}

RIIS_INLINE float longest_edge(const TriangleGroup &group) {
  const Floats longest =
      greatest(greatest(Floats::load(group.half_ab), Floats::load(group.half_ac)), Floats::load(group.half_bc));
  const Floats opposite_of_longest = Floats::all(0) - longest;
  const Floats four[4] = {opposite_of_longest, opposite_of_longest, opposite_of_longest, opposite_of_longest};
  float longest_lane[4];
  least_lanes(four, longest_lane);
  return -round_down(2 * longest_lane[0]);
}

void make_groups(const GroupCorners *corners, int32_t n, TriangleGroup *groups, GroupBounds *bounds) {
  alignas(64) float rounded[groups_at_once][9][triangles_per_group];
  alignas(64) double across[3][groups_at_once] = {}, along[3][groups_at_once] = {};
  for (int32_t g = 0; g < n; ++g) {
    // The frames of many fine triangles do not fit in the cache, so the memory of the next group is requested in advance.
    if (g + 1 < n)
      for (__SIZE_TYPE__ at = 0; at < sizeof *groups; at += 64)
        __builtin_prefetch(reinterpret_cast<const char *>(groups + g + 1) + at, 1);
    double normal[3];
    make_frames(corners[g], groups[g], rounded[g], normal);
    for (int32_t i = bounds[g].n; i < triangles_per_group; ++i) groups[g].g_origin[i] = beyond_limits;
    for (int i = 0; i < 3; ++i) {
      across[i][g] = normal[i];
      along[i][g] = corners[g].xyz[3 + i][0] - corners[g].xyz[i][0];
    }
  }
  const auto vectors = [](const double(&from)[3][groups_at_once]) RIIS_LAMBDA {
    return Doubles3{Doubles::load(from[0]), Doubles::load(from[1]), Doubles::load(from[2])};
  };
  Axes axes;
  choose_axes(vectors(across), vectors(along), axes);
  for (int32_t g = 0; g < n; ++g) {
    for (int k = 0; k < 3; ++k)
      for (int i = 0; i < 3; ++i) bounds[g].axis[k][i] = static_cast<float>(axes.of[k][i][g]);
    bound_group(rounded[g], bounds[g]);
    bounds[g].longest_edge = longest_edge(groups[g]);
  }
}

template <bool has_derivatives>
RIIS_INLINE void sum_cubes_of(const CubeSources &sources, const double *at, CubeSums &sums) {
  const Doubles3 y{Doubles::all(at[0]), Doubles::all(at[1]), Doubles::all(at[2])};
  const Doubles none = Doubles::all(0);
  Doubles3 value{none, none, none}, by_x = value, by_y = value, by_z = value;
  const auto lanes = [](const double *const(&from)[3], int64_t i) RIIS_LAMBDA {
    return Doubles3{Doubles::load_unaligned(from[0] + i), Doubles::load_unaligned(from[1] + i),
                    Doubles::load_unaligned(from[2] + i)};
  };
  for (int64_t i = 0; i < sources.n; i += Doubles::n) {
    const Doubles3 d = y - lanes(sources.source, i), weight = lanes(sources.weight, i);
    const Doubles square = dot(d, d), r = root(square);
    value = value + square * r * weight;
    if (has_derivatives) {
      const Doubles3 of_r = r * weight;
      by_x = by_x + d.x * of_r, by_y = by_y + d.y * of_r, by_z = by_z + d.z * of_r;
    }
  }
  const auto sum = [](Doubles3 of, double(&to)[3])
                       RIIS_LAMBDA { to[0] = sum_of(of.x), to[1] = sum_of(of.y), to[2] = sum_of(of.z); };
  sum(value, sums.value);
  if (!has_derivatives) return;
  sum(by_x, sums.third_along[0]);
  sum(by_y, sums.third_along[1]);
  sum(by_z, sums.third_along[2]);
}

void sum_cubes(const CubeSources &sources, const double *at, CubeSums &sums) { sum_cubes_of<false>(sources, at, sums); }
void sum_cubes_with_derivatives(const CubeSources &sources, const double *at, CubeSums &sums) {
  sum_cubes_of<true>(sources, at, sums);
}

}  // namespace

const DecisionKernels RIIS_KERNELS(decision_kernels) = {
    take_corners, have_area, place_points,    measure_triangles, frame_group, frame_leaf, make_groups,
    decide,       locate,    mix_at_vertices, differentiate,     find_sides,  sum_cubes,  sum_cubes_with_derivatives};

}  // namespace riis
