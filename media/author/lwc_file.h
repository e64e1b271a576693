#pragma once
// The plain-text files of liquid water that SHDOM and the I3RC community model read, and the CSV form of AT3D and pyshdom.
//
//     2 parameter LWC file         first word 1: LWC alone; 2: LWC and effective radius
//     nx ny nz
//     dx dy                        [km]
//     z ...                        [km]: nz heights of points (SHDOM), or nz + 1 bounds of cells (I3RC)
//     T ...                        [K], as many; not used
//     ix iy iz LWC Reff            from 1 on; g/m³ and µm; what has no line is clear
//
// After the READ_PARTICLE_FILE of SHDOM's propgen (K. F. Evans, https://coloradolinux.com/shdom) and the comments of
// PhysicalPropertiesToDomain in the I3RC Monte Carlo model (R. Pincus, K. F. Evans, https://github.com/RobertPincus/i3rc-monte-carlo-model).
// AT3D's CSV begins with a comment, has no temperatures and a line of column names (https://github.com/CloudTomography/AT3D,
// at3d/data/synthetic_cloud_fields).

#include <string>

#include "media/author/water_field.h"

namespace arcus::media {

/// Points of SHDOM count as the middles of cells that meet half-way between them. x and y begin at 0: the first point's position, or
/// the first cell's edge. Files of form 3 (several kinds of particles) are refused, as is everything with a line too short,
/// an index outside of the lattice, or two lines for one place. Throws bad_input with the line.
WaterField read_lwc_file(const std::string& path);

}  // namespace arcus::media
