// SPDX-License-Identifier: Apache-2.0
// The physiological defaults of one beat, in SI units: the pressures in a heart at rest, and the body behind the aorta.
#pragma once

#include <vector>

namespace riis::program {

inline constexpr double mmHg = 133.322;         // Pa
inline constexpr double beat_period = 0.8;      // s
inline constexpr double motion_seconds = 0.04;  // in which a valve opens, and in which it closes
// The dwell time of the law of opening. Closing leaflets push blood back, and the pressure of this blood must not open the valve
// again. Each motion of the leaflets therefore ends before the next motion may begin, as in svMultiPhysics.
inline constexpr double dwell_seconds = motion_seconds;
// Pa. The opening pressure is larger than the rounding error of the difference between two equal pressures.
inline constexpr double opening_pressure = 50;
// m3/s. A mitral valve closes when the flow falls below a small value, so that less blood returns.
inline constexpr double closing_flow_of_mitral = 1e-4;

// A pressure as a function of time, which is linear between its keys. The function repeats with the period beat_period.
struct PressureCurve {
  struct Key {
    double time, pressure;  // s, mmHg
  };
  std::vector<Key> keys;

  double at(double time) const {  // in Pa, from 0 to the period
    std::size_t i = 1;
    while (i + 1 < keys.size() && keys[i].time < time) ++i;
    const Key &a = keys[i - 1], &b = keys[i];
    return mmHg * (a.pressure + (b.pressure - a.pressure) * (time - a.time) / (b.time - a.time));
  }
};

// The pressure of the ventricle in a beat that begins at the end of diastole. It drives an aortic valve.
inline const PressureCurve &pressure_of_left_ventricle() {
  static const PressureCurve curve{
      {{0, 8}, {0.04, 8}, {0.09, 78}, {0.14, 108}, {0.2, 120}, {0.27, 112}, {0.32, 95}, {0.38, 8}, {0.8, 8}}};
  return curve;
}
// The pressure of the ventricle in a beat that begins before the ventricle is filled. Blood from the atrium fills the ventricle
// through a mitral valve.
inline const PressureCurve &pressure_of_filling_ventricle() {
  static const PressureCurve curve{{{0, 12}, {0.03, 12}, {0.08, 4}, {0.4, 4}, {0.5, 100}, {0.76, 100}, {0.8, 12}}};
  return curve;
}
inline constexpr double pressure_of_left_atrium = 10 * mmHg;

// The body behind the aorta: a Windkessel with three elements.
struct Windkessel {
  double proximal_resistance = 6.67e6, distal_resistance = 1.9e8;  // Pa s/m3
  double compliance = 1.05e-8;                                     // m3/Pa
  double distal_pressure = 0, initial_pressure = 80 * mmHg;        // Pa
};

}  // namespace riis::program
