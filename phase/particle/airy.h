#pragma once
// Airy functions of real argument: what light does at a caustic. DLMF chapter 9.

namespace arcus::phase {

struct AiryValues {
  double ai, ai_slope;  ///< Ai(z), Ai'(z)
  double bi, bi_slope;  ///< Bi(z), Bi'(z); infinite where they overflow (z above 100)
};

/// Error relative to the modulus (z < 0: of Ai + i Bi) below 5e-9 up to z = 4 and below 2e-5
/// beyond, where Ai is small.
AiryValues airy(double z);

}  // namespace arcus::phase
