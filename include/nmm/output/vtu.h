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
   * Writes the fields of a state to @p base .vtu, or in parallel to a file .RANK.vtu of each rank
   * and .pvtu. Manifold elements are written as VTK's quadratic triangles with six nodes. The
   * fields are displacement, direct and recovered stress, von Mises and principal stresses
   * (of the recovered stress), the numbers of block, region and material, the rank, and velocity
   * and plastic strain if there are any. Positions have double precision, other numbers single precision. ParaView's "Warp
   * by vector" of the displacement shows the deformed shape. Returns the name of
   * the file, for FileSeries. Collective, but does not wait for the files of other ranks.
   *
   * Arrays are stored without compression. zlib's fastest level would reduce the size to less than
   * a third, but takes longer than a linear time step. Cost: 0.14 kB per node.
   */
  std::string
  write_fields_of_state(const CoverSystem     &covers,
                        const FieldTriangles  &triangles,
                        const OutputDirectory &directory,
                        const std::string     &base);


  /**
   * The list of the files of a series of states for ParaView, a file .pvd. It always names
   * the files that exist at the time. For use on one rank.
   *
   * Lifetime: the directory must outlive this object.
   */
  class FileSeries
  {
  public:
    /// An empty list, which is written to `base`.pvd in @p directory when a state is added.
    FileSeries(const OutputDirectory &directory, std::string base);

    /// Takes over the files "base-..." that the list of an earlier run has for states up to the
    /// time or load factor @p last.
    void
    resume(double last);

    /// Adds the state at the time or load factor @p value, which is in @p file.
    void
    add(double value, const std::string &file);

    /// Adds the final state, unless a file of it is listed already.
    void
    finish(double value, const std::string &file);

    /// Whether a file of the state @p value is listed, up to rounding errors of the value.
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
