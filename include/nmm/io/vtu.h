#ifndef nmm_io_vtu_h
#define nmm_io_vtu_h

#include <nmm/io/field_samples.h>
#include <nmm/io/output_directory.h>

namespace NMM
{
  /**
   * Write fields.vtu, in parallel one fields.<rank>.vtu each and fields.pvtu,
   * and fields.pvd: manifold elements as triangles with six nodes (VTK's Lagrange
   * triangle of order 2) with displacement, direct and recovered stress, von
   * Mises and principal stresses (of the recovered stress), block, region and
   * material numbers and the rank. Numbers are single precision. ParaView's "Warp
   * by vector" of the displacement shows the deformed shape.
   */
  void
  write_fields(const CoverSystem     &covers,
               const FieldTriangles  &triangles,
               const OutputDirectory &directory);
} // namespace NMM

#endif
