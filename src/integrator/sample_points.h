#pragma once
// Evenly spread numbers for the first decisions of a pixel's paths: Sobol's sequence in five dimensions, scrambled per
// pixel by hashing (Burley, "Practical Hash-based Owen Scrambling", JCGT 9(4), 2020). Any number of samples may be
// taken or added later; sample i of a pixel is always the same.

#include <array>
#include <cstdint>

namespace arcus::render {

/// What the first numbers of a path decide.
struct FirstNumbers {
  double pixel_x, pixel_y;  ///< where in the pixel
  double wavelength;        ///< which wavelengths
  double collision;         ///< how far the camera ray goes before it first meets something
  double choice;            ///< what it does there
};

/// Sample number `sample` of pixel `pixel` under `seed`; every number is in [0, 1) and uniform over the seeds.
FirstNumbers first_numbers(std::uint64_t seed, std::uint64_t pixel, std::uint32_t sample);

}  // namespace arcus::render
