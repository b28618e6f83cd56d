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
   * Write @p base .vtu, in parallel one .RANK.vtu each and .pvtu: manifold
   * elements as triangles with six nodes (VTK's quadratic
   * triangle) with displacement, direct and recovered stress, von
   * Mises and principal stresses (of the recovered stress), block, region and
   * material numbers and the rank. Numbers are single precision. ParaView's "Warp
   * by vector" of the displacement shows the deformed shape. Returns the name of
   * the file, for FileSeries; collective, but does not wait for other ranks'
   * files.
   *
   * Arrays are stored without compression: zlib's fastest level makes less than a third
   * of the size, but takes longer than a linear time step. Cost: 0.14 kB per node.
   */
  std::string
  write_fields_of_state(const CoverSystem     &covers,
                        const FieldTriangles  &triangles,
                        const OutputDirectory &directory,
                        const std::string     &base);


  /**
   * Files of states of a run, and the list of them for ParaView, @p base .pvd, which
   * at any time names those that are there. For use on one rank.
   *
   * Lifetime: the directory must outlive this object.
   */
  class FileSeries
  {
  public:
    FileSeries(const OutputDirectory &directory, std::string base);

    /// Keep what an earlier run listed of files "base-..." of states up to @p last.
    void
    resume(double last);

    /// The state @p value (time or load factor) is in @p file.
    void
    add(double value, const std::string &file);

    /// The same for the last state, unless it is listed already.
    void
    finish(double value, const std::string &file);

    /// Is a file of the state @p value listed, but for rounding?
    bool
    has(double value) const;

  private:
    void
    write_list() const;

    const OutputDirectory                      *directory;
    std::string                                 base;
    std::vector<std::pair<double, std::string>> states;
  };
} // namespace NMM

#endif
