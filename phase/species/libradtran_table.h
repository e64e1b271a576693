#pragma once
// The NetCDF files that libRadtran's mie tool writes with `output_user netcdf` (C. Emde et al., Geosci. Model Dev. 9, 1647 (2016);
// user's guide of libRadtran 2.0, tool mie): wavelen(nlam) and reff(nreff) in µm, ntheta and theta(nlam, nreff, nphamat, nthetamax) in
// degrees, phase like theta with mean 1 over the sphere, in the order P11, P12, P33, P34, ext(nlam, nreff) in km⁻¹/(g/m³), ssa
// and rho in g/cm³.

#include "phase/base/netcdf_file.h"
#include "phase/species/table_file.h"

namespace arcus::phase {

/// Whether a file has those variables.
bool is_libradtran_table(const NetcdfFile& file);

/// Sizes are reff, cross-sections those of a sphere of that radius with the file's ext, so that extinction goes with the wavelength as in
/// the file. Of the wavelengths those are kept that light is rendered at, with the next beyond; no forward lobe is removed. The
/// angles of all rows together are the table's nodes; between its own nodes a row is linear in cos θ, as libRadtran has it. Rows whose integral is off by more than 1 % are normalised with a warning, by more than 20 % refused,
/// as are tables by humidity instead of size. Throws bad_input.
TableFile read_libradtran_table(const std::string& path);

}  // namespace arcus::phase
