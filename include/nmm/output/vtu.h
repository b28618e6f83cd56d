#ifndef nmm_output_vtu_h
#define nmm_output_vtu_h

#include <nmm/output/field_samples.h>
#include <nmm/output/output_directory.h>

#include <string>
#include <utility>
#include <vector>

namespace NMM
{
  /**
   * Write @p base .vtu, in parallel one .<rank>.vtu each and .pvtu: manifold
   * elements as triangles with six nodes (VTK's Lagrange
   * triangle of order 2) with displacement, direct and recovered stress, von
   * Mises and principal stresses (of the recovered stress), block, region and
   * material numbers and the rank. Numbers are single precision. ParaView's "Warp
   * by vector" of the displacement shows the deformed shape. Returns the name of
   * the file, for write_series(); collective, but does not wait for other ranks'
   * files.
   *
   * Cost: some half a microsecond and 85 bytes per node; arrays that hardly shrink are
   * stored, which takes a third of the time and 1.6 times the space of zlib's
   * fastest level.
   */
  std::string
  write_fields_of_state(const CoverSystem     &covers,
                        const FieldTriangles  &triangles,
                        const OutputDirectory &directory,
                        const std::string     &base);

  /// fields.pvd of states at times (or load factors). On one rank only.
  void
  write_series(const std::vector<std::pair<double, std::string>> &states,
               const OutputDirectory                             &directory);

  /// The same of other files, in a list called @p name.
  void
  write_series(const std::vector<std::pair<double, std::string>> &states,
               const OutputDirectory                             &directory,
               const std::string                                 &name);
} // namespace NMM

#endif
