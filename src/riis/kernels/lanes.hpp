// SPDX-License-Identifier: Apache-2.0
// This file computes with sixteen floats or eight doubles at once. The file that includes this header is compiled for one
// instruction set, and the code uses the registers of this set. Everything has internal linkage. Files for different instruction
// sets must not share a function, because the linker could take the function from the wrong file. For the same reason, this file
// includes no header with inline functions that the compiler may emit as separate functions.
#pragma once

// RIIS_PORTABLE_LANES selects the code for processors without SSE2 or NEON. Tests also run this code on processors with SSE2 or
// NEON.
#if defined(__SSE2__) && !defined(RIIS_PORTABLE_LANES)
#define RIIS_SSE2
#include <immintrin.h>
#elif defined(__aarch64__) && defined(__ARM_NEON) && !defined(RIIS_PORTABLE_LANES)
#define RIIS_NEON
#include <arm_neon.h>
#endif
#include <stdint.h>

namespace riis {

// Counts of operations, in kernels that are compiled with RIIS_COUNT_OPERATIONS. Only ./run bench roofline links such kernels. In
// all other kernels, counting compiles to nothing. `operations` counts arithmetic instructions and comparisons in one lane. A
// multiply-add counts as one operation. `pairs` counts the pairs of a node and a triangle whose distance the filter computed.
struct Counts {
  int64_t operations, pairs;
};
extern Counts counts_of_kernels;

namespace {

inline __attribute__((always_inline)) void count(int64_t Counts::*which, int64_t n) {
#if defined(RIIS_COUNT_OPERATIONS)
  counts_of_kernels.*which += n;
#else
  static_cast<void>(which), static_cast<void>(n);
#endif
}

#if defined(__AVX512F__)
constexpr int register_bytes = 64;
#elif defined(__AVX2__)
constexpr int register_bytes = 32;
#else
constexpr int register_bytes = 16;
#endif

#define RIIS_INLINE inline __attribute__((always_inline))

typedef float FloatRegister __attribute__((vector_size(register_bytes)));
typedef int32_t IntRegister __attribute__((vector_size(register_bytes)));
typedef double DoubleRegister __attribute__((vector_size(register_bytes)));
typedef int64_t LongRegister __attribute__((vector_size(register_bytes)));

template <class Register>
struct ComparisonOf;
template <>
struct ComparisonOf<FloatRegister> {
  typedef IntRegister type;
};
template <>
struct ComparisonOf<DoubleRegister> {
  typedef LongRegister type;
};

// Returns a < b ? a : b, which is b if `a` is NaN. NEON gives another result in two cases: only b is NaN, or a and b are zeros of
// different signs. The first case does not occur. The second case does no harm, because nothing reads the sign of a zero.
RIIS_INLINE FloatRegister least(FloatRegister a, FloatRegister b) {
#if defined(__AVX512F__)
  return (FloatRegister)_mm512_min_ps((__m512)a, (__m512)b);
#elif defined(__AVX2__)
  return (FloatRegister)_mm256_min_ps((__m256)a, (__m256)b);
#elif defined(RIIS_SSE2)
  return (FloatRegister)_mm_min_ps((__m128)a, (__m128)b);
#elif defined(RIIS_NEON)
  return (FloatRegister)vminnmq_f32((float32x4_t)a, (float32x4_t)b);
#else
  return a < b ? a : b;
#endif
}

// Returns a > b ? a : b, with the same exceptions as least().
RIIS_INLINE FloatRegister greatest(FloatRegister a, FloatRegister b) {
#if defined(__AVX512F__)
  return (FloatRegister)_mm512_max_ps((__m512)a, (__m512)b);
#elif defined(__AVX2__)
  return (FloatRegister)_mm256_max_ps((__m256)a, (__m256)b);
#elif defined(RIIS_SSE2)
  return (FloatRegister)_mm_max_ps((__m128)a, (__m128)b);
#elif defined(RIIS_NEON)
  return (FloatRegister)vmaxnmq_f32((float32x4_t)a, (float32x4_t)b);
#else
  return a > b ? a : b;
#endif
}

RIIS_INLINE DoubleRegister least(DoubleRegister a, DoubleRegister b) {
#if defined(__AVX512F__)
  return (DoubleRegister)_mm512_min_pd((__m512d)a, (__m512d)b);
#elif defined(__AVX2__)
  return (DoubleRegister)_mm256_min_pd((__m256d)a, (__m256d)b);
#elif defined(RIIS_SSE2)
  return (DoubleRegister)_mm_min_pd((__m128d)a, (__m128d)b);
#elif defined(RIIS_NEON)
  return (DoubleRegister)vminnmq_f64((float64x2_t)a, (float64x2_t)b);
#else
  return a < b ? a : b;
#endif
}

RIIS_INLINE DoubleRegister greatest(DoubleRegister a, DoubleRegister b) {
#if defined(__AVX512F__)
  return (DoubleRegister)_mm512_max_pd((__m512d)a, (__m512d)b);
#elif defined(__AVX2__)
  return (DoubleRegister)_mm256_max_pd((__m256d)a, (__m256d)b);
#elif defined(RIIS_SSE2)
  return (DoubleRegister)_mm_max_pd((__m128d)a, (__m128d)b);
#elif defined(RIIS_NEON)
  return (DoubleRegister)vmaxnmq_f64((float64x2_t)a, (float64x2_t)b);
#else
  return a > b ? a : b;
#endif
}

// Returns a * b + c. The result is rounded only once if the instruction set can do that.
RIIS_INLINE FloatRegister multiply_add(FloatRegister a, FloatRegister b, FloatRegister c) {
#if defined(__AVX512F__)
  return (FloatRegister)_mm512_fmadd_ps((__m512)a, (__m512)b, (__m512)c);
#elif defined(__AVX2__) && defined(__FMA__)
  return (FloatRegister)_mm256_fmadd_ps((__m256)a, (__m256)b, (__m256)c);
#elif defined(RIIS_NEON)
  return (FloatRegister)vfmaq_f32((float32x4_t)c, (float32x4_t)a, (float32x4_t)b);
#else
  return a * b + c;
#endif
}

// Returns c - a * b. The result is rounded only once if the instruction set can do that.
RIIS_INLINE FloatRegister subtract_product(FloatRegister a, FloatRegister b, FloatRegister c) {
#if defined(__AVX512F__)
  return (FloatRegister)_mm512_fnmadd_ps((__m512)a, (__m512)b, (__m512)c);
#elif defined(__AVX2__) && defined(__FMA__)
  return (FloatRegister)_mm256_fnmadd_ps((__m256)a, (__m256)b, (__m256)c);
#elif defined(RIIS_NEON)
  return (FloatRegister)vfmsq_f32((float32x4_t)c, (float32x4_t)a, (float32x4_t)b);
#else
  return c - a * b;
#endif
}

// The lanes of several registers. A comparison gives 0 or -1 in each lane.
template <class Scalar, class Register, int n_lanes>
struct Lanes {
  static constexpr int n = n_lanes;
  static constexpr int per_register = register_bytes / static_cast<int>(sizeof(Scalar));
  static constexpr int n_registers = n_lanes / per_register;
  typedef typename ComparisonOf<Register>::type Comparison;
  struct Mask {
    Comparison part[n_registers];
  };

  typedef Register InMemory __attribute__((may_alias));
  typedef Register Unaligned __attribute__((may_alias, aligned(alignof(Scalar))));

  Register part[n_registers];

  static RIIS_INLINE Lanes all(Scalar x) {
    Lanes lanes;
    for (int i = 0; i < n_registers; ++i) lanes.part[i] = x - Register{};
    return lanes;
  }
  // load and store need memory aligned to 64 bytes. Both functions move one register at a time. GCC would copy a whole object in
  // parts of another size. A register could then span two parts, and reading it would have to wait until both parts are written.
  static RIIS_INLINE Lanes load(const Scalar *from) {
    Lanes lanes;
    for (int i = 0; i < n_registers; ++i) lanes.part[i] = reinterpret_cast<const InMemory *>(from)[i];
    return lanes;
  }
  static RIIS_INLINE Lanes load_unaligned(const Scalar *from) {
    Lanes lanes;
    for (int i = 0; i < n_registers; ++i) lanes.part[i] = reinterpret_cast<const Unaligned *>(from)[i];
    return lanes;
  }
  // Fills a register with numbers. Each lane has an address from which its number is read.
  static RIIS_INLINE Register gather_register(const Scalar *const *f, int64_t offset) {
    if constexpr (per_register == 8)
      return Register{f[0][offset], f[1][offset], f[2][offset], f[3][offset],
                      f[4][offset], f[5][offset], f[6][offset], f[7][offset]};
    else if constexpr (per_register == 4)
      return Register{f[0][offset], f[1][offset], f[2][offset], f[3][offset]};
    else if constexpr (per_register == 2)
      return Register{f[0][offset], f[1][offset]};
    else {
      Register r;
      for (int j = 0; j < per_register; ++j) r[j] = f[j][offset];
      return r;
    }
  }
  // Gathers one number from each of n addresses.
  static RIIS_INLINE Lanes gather(const Scalar *const *from, int64_t offset) {
    Lanes lanes;
    for (int i = 0; i < n_registers; ++i) lanes.part[i] = gather_register(from + i * per_register, offset);
    return lanes;
  }
  RIIS_INLINE void store(Scalar *to) const {
    for (int i = 0; i < n_registers; ++i) reinterpret_cast<InMemory *>(to)[i] = part[i];
  }

// The body of a function that works register by register: register i of the result depends only on the registers i of the
// arguments.
#define RIIS_LANEWISE(Result, expression)                       \
  Result r;                                                     \
  for (int i = 0; i < n_registers; ++i) r.part[i] = expression; \
  return r
#define RIIS_ARITHMETIC(Result, expression) \
  count(&Counts::operations, n);            \
  RIIS_LANEWISE(Result, expression)

  // clang-format off
  friend RIIS_INLINE Lanes operator+(Lanes a, Lanes b) { RIIS_ARITHMETIC(Lanes, a.part[i] + b.part[i]); }
  friend RIIS_INLINE Lanes operator-(Lanes a, Lanes b) { RIIS_ARITHMETIC(Lanes, a.part[i] - b.part[i]); }
  friend RIIS_INLINE Lanes operator*(Lanes a, Lanes b) { RIIS_ARITHMETIC(Lanes, a.part[i] * b.part[i]); }
  friend RIIS_INLINE Lanes operator/(Lanes a, Lanes b) { RIIS_ARITHMETIC(Lanes, a.part[i] / b.part[i]); }
  friend RIIS_INLINE Mask operator<(Lanes a, Lanes b) { RIIS_ARITHMETIC(Mask, a.part[i] < b.part[i]); }
  friend RIIS_INLINE Mask operator<=(Lanes a, Lanes b) { RIIS_ARITHMETIC(Mask, a.part[i] <= b.part[i]); }
  friend RIIS_INLINE Mask operator>(Lanes a, Lanes b) { return b < a; }
  friend RIIS_INLINE Mask operator>=(Lanes a, Lanes b) { return b <= a; }
  friend RIIS_INLINE Mask operator==(Lanes a, Lanes b) { RIIS_ARITHMETIC(Mask, a.part[i] == b.part[i]); }
  friend RIIS_INLINE Lanes least(Lanes a, Lanes b) { RIIS_ARITHMETIC(Lanes, least(a.part[i], b.part[i])); }
  friend RIIS_INLINE Lanes greatest(Lanes a, Lanes b) { RIIS_ARITHMETIC(Lanes, greatest(a.part[i], b.part[i])); }
  friend RIIS_INLINE Lanes multiply_add(Lanes a, Lanes b, Lanes c) {
    RIIS_ARITHMETIC(Lanes, multiply_add(a.part[i], b.part[i], c.part[i]));
  }
  friend RIIS_INLINE Lanes subtract_product(Lanes a, Lanes b, Lanes c) {
    RIIS_ARITHMETIC(Lanes, subtract_product(a.part[i], b.part[i], c.part[i]));
  }
  friend RIIS_INLINE Lanes choose(Mask where, Lanes yes, Lanes no) {
    RIIS_LANEWISE(Lanes, where.part[i] ? yes.part[i] : no.part[i]);
  }
  // clang-format on
};

typedef Lanes<float, FloatRegister, 16> Floats;
typedef Lanes<double, DoubleRegister, 8> Doubles;

#if defined(__AVX512F__)
typedef __m512d Row;  // four neighbouring numbers for lane i, and four for lane i + 4
RIIS_INLINE Row unpack_low(Row a, Row b) { return _mm512_unpacklo_pd(a, b); }
RIIS_INLINE Row unpack_high(Row a, Row b) { return _mm512_unpackhi_pd(a, b); }
RIIS_INLINE Row low_halves(Row a, Row b) {
  return _mm512_permutex2var_pd(a, _mm512_setr_epi64(0, 1, 8, 9, 4, 5, 12, 13), b);
}
RIIS_INLINE Row high_halves(Row a, Row b) {
  return _mm512_permutex2var_pd(a, _mm512_setr_epi64(2, 3, 10, 11, 6, 7, 14, 15), b);
}
#elif defined(__AVX2__)
typedef __m256d Row;  // four neighbouring numbers for one lane
RIIS_INLINE Row unpack_low(Row a, Row b) { return _mm256_unpacklo_pd(a, b); }
RIIS_INLINE Row unpack_high(Row a, Row b) { return _mm256_unpackhi_pd(a, b); }
RIIS_INLINE Row low_halves(Row a, Row b) { return _mm256_permute2f128_pd(a, b, 0x20); }
RIIS_INLINE Row high_halves(Row a, Row b) { return _mm256_permute2f128_pd(a, b, 0x31); }
#endif

// Gathers n points for each of eight lanes. A lane's points are stored one after another from address(lane) on. No other number
// is read.
template <int n, class Address>
RIIS_INLINE void gather_points(const Address &address, Doubles (&xyz)[n][3]) {
#if defined(__AVX2__)
  // A load reads four numbers, but a point has three. The load also reads the number after the point, or, for the last point, the
  // number before it. A single point has no such neighbour, so a mask leaves the fourth number out.
  constexpr int last = n - 1;
  const auto load = [](const double *from, int k) __attribute__((always_inline)) {
    if constexpr (n == 1) return _mm256_maskload_pd(from, _mm256_setr_epi64x(-1, -1, -1, 0));
    return _mm256_loadu_pd(from + (k < last ? 3 * k : 3 * last - 1));
  };
  for (int part = 0; part < Doubles::n_registers; ++part) {
    Row rows[n][4];
    // Uses each address as soon as it is known, because a processor has too few registers to keep all addresses.
    for (int i = 0; i < 4; ++i) {
#if defined(__AVX512F__)
      const double *const from = address(i), *const later = address(i + 4);
      for (int k = 0; k < n; ++k)
        rows[k][i] = _mm512_insertf64x4(_mm512_castpd256_pd512(load(from, k)), load(later, k), 1);
#else
      const double *const from = address(4 * part + i);
      for (int k = 0; k < n; ++k) rows[k][i] = load(from, k);
#endif
    }
    for (int k = 0; k < n; ++k) {
      const Row(&r)[4] = rows[k];
      const Row even01 = unpack_low(r[0], r[1]), even23 = unpack_low(r[2], r[3]);
      const Row odd01 = unpack_high(r[0], r[1]), odd23 = unpack_high(r[2], r[3]);
      const bool begins_before = n > 1 && k == last;
      xyz[k][0].part[part] = (DoubleRegister)(begins_before ? low_halves(odd01, odd23) : low_halves(even01, even23));
      xyz[k][1].part[part] = (DoubleRegister)(begins_before ? high_halves(even01, even23) : low_halves(odd01, odd23));
      xyz[k][2].part[part] = (DoubleRegister)(begins_before ? high_halves(odd01, odd23) : high_halves(even01, even23));
    }
  }
#else
  const double *from[Doubles::n];
  for (int lane = 0; lane < Doubles::n; ++lane) from[lane] = address(lane);
  for (int k = 0; k < n; ++k)
    for (int i = 0; i < 3; ++i) xyz[k][i] = Doubles::gather(from, 3 * k + i);
#endif
}

template <class Mask>
RIIS_INLINE Mask both(Mask a, Mask b) {
  Mask r;
  for (unsigned i = 0; i < sizeof r.part / sizeof r.part[0]; ++i) r.part[i] = a.part[i] & b.part[i];
  return r;
}

template <class Mask>
RIIS_INLINE Mask opposite(Mask a) {
  Mask r;
  for (unsigned i = 0; i < sizeof r.part / sizeof r.part[0]; ++i) r.part[i] = ~a.part[i];
  return r;
}

#if defined(RIIS_NEON)
// Takes 0 or -1 in each of eight lanes, and returns one bit for each lane. NEON has no instruction for this conversion. Each lane
// therefore keeps a different bit, and the sum of the lanes combines all bits.
RIIS_INLINE uint32_t bits(uint16x8_t mask) {
  return vaddvq_u16(vandq_u16(mask, uint16x8_t{1, 2, 4, 8, 16, 32, 64, 128}));
}
// Takes 0 or -1 in each of sixteen lanes, and returns one bit for each lane. One byte of each lane is enough. The bytes of lanes
// i and i + 8 become neighbours.
RIIS_INLINE uint32_t bits(uint16x8_t first, uint16x8_t last) {
  const uint8x16_t bytes = vtrn1q_u8(vreinterpretq_u8_u16(first), vreinterpretq_u8_u16(last));
  const uint16x8_t own_bits = {0x0101, 0x0202, 0x0404, 0x0808, 0x1010, 0x2020, 0x4040, 0x8080};
  return vaddvq_u16(vandq_u16(vreinterpretq_u16_u8(bytes), own_bits));
}
#endif

// Returns one bit for each lane. The lowest bit belongs to the first lane.
RIIS_INLINE uint32_t bits(Floats::Mask mask) {
#if defined(__AVX512DQ__)
  return _mm512_movepi32_mask((__m512i)mask.part[0]);
#elif defined(__AVX2__)
  return static_cast<uint32_t>(_mm256_movemask_ps((__m256)mask.part[0])) |
         static_cast<uint32_t>(_mm256_movemask_ps((__m256)mask.part[1])) << 8;
#elif defined(RIIS_SSE2)
  uint32_t r = 0;
  for (int i = 0; i < 4; ++i) r |= static_cast<uint32_t>(_mm_movemask_ps((__m128)mask.part[i])) << 4 * i;
  return r;
#elif defined(RIIS_NEON)
  return bits(vuzp1q_u16((uint16x8_t)mask.part[0], (uint16x8_t)mask.part[1]),
              vuzp1q_u16((uint16x8_t)mask.part[2], (uint16x8_t)mask.part[3]));
#else
  uint32_t r = 0;
  for (int i = 0; i < 16; ++i) r |= static_cast<uint32_t>(mask.part[i / 4][i % 4] & 1) << i;
  return r;
#endif
}

RIIS_INLINE uint32_t bits(Doubles::Mask mask) {
#if defined(__AVX512DQ__)
  return _mm512_movepi64_mask((__m512i)mask.part[0]);
#elif defined(__AVX2__)
  return static_cast<uint32_t>(_mm256_movemask_pd((__m256d)mask.part[0])) |
         static_cast<uint32_t>(_mm256_movemask_pd((__m256d)mask.part[1])) << 4;
#elif defined(RIIS_SSE2)
  uint32_t r = 0;
  for (int i = 0; i < 4; ++i) r |= static_cast<uint32_t>(_mm_movemask_pd((__m128d)mask.part[i])) << 2 * i;
  return r;
#elif defined(RIIS_NEON)
  const uint32x4_t first = vuzp1q_u32((uint32x4_t)mask.part[0], (uint32x4_t)mask.part[1]);
  const uint32x4_t last = vuzp1q_u32((uint32x4_t)mask.part[2], (uint32x4_t)mask.part[3]);
  return bits(vuzp1q_u16(vreinterpretq_u16_u32(first), vreinterpretq_u16_u32(last)));
#else
  uint32_t r = 0;
  for (int i = 0; i < 8; ++i) r |= static_cast<uint32_t>(mask.part[i / 2][i % 2] & 1) << i;
  return r;
#endif
}

// Returns bits(a <= b).
RIIS_INLINE uint32_t bits_at_most(Floats a, Floats b) {
#if defined(__AVX512F__)
  return _mm512_cmp_ps_mask((__m512)a.part[0], (__m512)b.part[0], _CMP_LE_OQ);
#else
  return bits(a <= b);
#endif
}

// Returns one bit for each lane. The bit is set if a and b differ in this lane.
RIIS_INLINE uint32_t bits_different(Floats a, Floats b) {
#if defined(__AVX512F__)
  return _mm512_cmp_ps_mask((__m512)a.part[0], (__m512)b.part[0], _CMP_NEQ_UQ);
#else
  return ~bits(a == b) & 0xffff;
#endif
}

// Returns the distance from x to the interval from -half to half, possibly with a minus sign.
RIIS_INLINE Floats beyond(Floats x, Floats half) {
#if defined(__AVX512DQ__)
  // One instruction limits the magnitude of x and keeps the sign of x.
  count(&Counts::operations, Floats::n);
  constexpr int lesser_magnitude_with_sign_of_first = 2;
  const __m512 limited = _mm512_range_ps((__m512)x.part[0], (__m512)half.part[0], lesser_magnitude_with_sign_of_first);
  return x - Floats{{(FloatRegister)limited}};
#else
  Floats magnitude;
  for (int i = 0; i < Floats::n_registers; ++i)
    magnitude.part[i] = (FloatRegister)((IntRegister)x.part[i] & (INT32_MAX - IntRegister{}));
  return greatest(magnitude - half, Floats::all(0));
#endif
}

// Converts floats whose values are whole numbers to integers.
RIIS_INLINE void to_integers(Floats x, int32_t *to) {
  for (int i = 0; i < Floats::n_registers; ++i) {
    const IntRegister integers = __builtin_convertvector(x.part[i], IntRegister);
    __builtin_memcpy(to + i * Floats::per_register, &integers, sizeof integers);
  }
}

// Returns 0 where a >= b, and x elsewhere.
RIIS_INLINE Floats zero_where_at_least(Floats a, Floats b, Floats x) {
#if defined(__AVX512F__)
  const __mmask16 keep = _mm512_cmp_ps_mask((__m512)a.part[0], (__m512)b.part[0], _CMP_NGE_UQ);
  Floats r;
  r.part[0] = (FloatRegister)_mm512_maskz_mov_ps(keep, (__m512)x.part[0]);
  return r;
#else
  return choose(a >= b, Floats::all(0), x);
#endif
}

// Reads 16 integers, and returns bit number `bit` of each one.
RIIS_INLINE uint32_t lanes_with_bit(const uint16_t *from, int32_t bit) {
#if defined(RIIS_SSE2)
  // The shift moves the bit to the sign. Packing the integers to bytes keeps their signs.
  const __m128i shift = _mm_cvtsi32_si128(15 - bit);
  const __m128i first = _mm_sll_epi16(_mm_loadu_si128(reinterpret_cast<const __m128i *>(from)), shift);
  const __m128i last = _mm_sll_epi16(_mm_loadu_si128(reinterpret_cast<const __m128i *>(from + 8)), shift);
  return static_cast<uint32_t>(_mm_movemask_epi8(_mm_packs_epi16(first, last)));
#elif defined(RIIS_NEON)
  const uint16x8_t wanted = vdupq_n_u16(static_cast<uint16_t>(1 << bit));
  return bits(vtstq_u16(vld1q_u16(from), wanted), vtstq_u16(vld1q_u16(from + 8), wanted));
#else
  uint32_t r = 0;
  for (int i = 0; i < 16; ++i) r |= static_cast<uint32_t>(from[i] >> bit & 1) << i;
  return r;
#endif
}

#if defined(__AVX2__) && !defined(__AVX512F__)
// A table of all sets of eight lanes. Each row lists the numbers of the lanes in one set, in ascending order. Unused entries are
// 0.
struct LanesOfSets {
  alignas(64) uint8_t lane[256][8] = {};
  constexpr LanesOfSets() {
    for (int set = 0; set < 256; ++set)
      for (int i = 0, n = 0; i < 8; ++i)
        if (set >> i & 1) lane[set][n++] = static_cast<uint8_t>(i);
  }
};
constexpr LanesOfSets lanes_of_sets;
#endif

// Copies, without gaps, those of 16 integers whose bit in `lanes` is set. The function may write to all 16 places of `to`, even
// if it copies fewer integers.
RIIS_INLINE void compress(uint32_t lanes, const int32_t *from, int32_t *to) {
#if defined(__AVX512F__)
  _mm512_storeu_si512(to, _mm512_maskz_compress_epi32(static_cast<__mmask16>(lanes), _mm512_loadu_si512(from)));
#elif defined(__AVX2__)
  for (int half = 0; half < 2; ++half) {
    const uint32_t set = lanes >> 8 * half & 0xff;
    const __m256i order =
        _mm256_cvtepu8_epi32(_mm_loadl_epi64(reinterpret_cast<const __m128i *>(lanes_of_sets.lane[set])));
    const __m256i of_half = _mm256_loadu_si256(reinterpret_cast<const __m256i *>(from + 8 * half));
    _mm256_storeu_si256(reinterpret_cast<__m256i *>(to), _mm256_permutevar8x32_epi32(of_half, order));
    to += __builtin_popcount(set);
  }
#else
  for (; lanes; lanes &= lanes - 1) *to++ = from[__builtin_ctz(lanes)];
#endif
}
RIIS_INLINE void fill(int32_t x, int32_t *to) {
  for (int i = 0; i < 16; ++i) to[i] = x;
}

RIIS_INLINE bool any(Doubles::Mask mask) { return bits(mask) != 0; }

// For each of four Floats, writes the least number in its lanes.
RIIS_INLINE void least_lanes(const Floats (&of)[4], float *least_lane) {
  count(&Counts::operations, 4 * (Floats::n - 1));
#if defined(__AVX512F__)
  // The first steps compare two quarters of a register, and the later steps compare two lanes of a quarter. Each step keeps the
  // lesser numbers.
  constexpr int first_half = 0x44, last_half = 0xee, even = 0x88, odd = 0xdd, neighbours = 0xb1, pairs = 0x4e;
  const auto halves = [&](int i) __attribute__((always_inline)) {
    const __m512 a = (__m512)of[i].part[0], b = (__m512)of[i + 1].part[0];
    return _mm512_min_ps(_mm512_shuffle_f32x4(a, b, first_half), _mm512_shuffle_f32x4(a, b, last_half));
  };
  const __m512 first = halves(0), last = halves(2);
  __m512 least_of = _mm512_min_ps(_mm512_shuffle_f32x4(first, last, even), _mm512_shuffle_f32x4(first, last, odd));
  least_of = _mm512_min_ps(least_of, _mm512_permute_ps(least_of, neighbours));
  least_of = _mm512_min_ps(least_of, _mm512_permute_ps(least_of, pairs));
  constexpr __mmask16 one_of_each_quarter = 0x1111;
  _mm_storeu_ps(least_lane, _mm512_castps512_ps128(_mm512_maskz_compress_ps(one_of_each_quarter, least_of)));
#elif defined(RIIS_SSE2)
  __m128 m[4];
  for (int i = 0; i < 4; ++i) {
#if defined(__AVX2__)
    const __m256 half = _mm256_min_ps((__m256)of[i].part[0], (__m256)of[i].part[1]);
    m[i] = _mm_min_ps(_mm256_castps256_ps128(half), _mm256_extractf128_ps(half, 1));
#else
    m[i] = (__m128)least(least(of[i].part[0], of[i].part[1]), least(of[i].part[2], of[i].part[3]));
#endif
  }
  // Twice joins neighbouring halves, and keeps the lesser number of two lanes each time.
  const __m128 first = _mm_min_ps(_mm_unpacklo_ps(m[0], m[1]), _mm_unpackhi_ps(m[0], m[1]));
  const __m128 last = _mm_min_ps(_mm_unpacklo_ps(m[2], m[3]), _mm_unpackhi_ps(m[2], m[3]));
  _mm_storeu_ps(least_lane, _mm_min_ps(_mm_movelh_ps(first, last), _mm_movehl_ps(last, first)));
#elif defined(RIIS_NEON)
  float32x4_t m[4];
  for (int i = 0; i < 4; ++i)
    m[i] = (float32x4_t)least(least(of[i].part[0], of[i].part[1]), least(of[i].part[2], of[i].part[3]));
  vst1q_f32(least_lane, vpminnmq_f32(vpminnmq_f32(m[0], m[1]), vpminnmq_f32(m[2], m[3])));
#else
  for (int i = 0; i < 4; ++i) {
    least_lane[i] = of[i].part[0][0];
    for (int k = 1; k < 16; ++k)
      if (of[i].part[k / Floats::per_register][k % Floats::per_register] < least_lane[i])
        least_lane[i] = of[i].part[k / Floats::per_register][k % Floats::per_register];
  }
#endif
}

}  // namespace
}  // namespace riis
