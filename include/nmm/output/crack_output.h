#ifndef nmm_output_crack_output_h
#define nmm_output_crack_output_h

#include <nmm/fracture/intensity_factors.h>
#include <nmm/output/output_directory.h>
#include <nmm/output/picture.h>

#include <string>
#include <utility>
#include <vector>

namespace NMM
{
  /// A crack tip, as it is written to files and pictures.
  struct TipSample
  {
    /// Position in the reference configuration [m].
    dealii::Point<2> x;
    /// Displacement of the tip [m].
    dealii::Tensor<1, 2> displacement;
    /// Unit vector in which the crack would grow straight on, in the reference configuration [-].
    dealii::Tensor<1, 2> direction;
    /// The intensity factors of the tip.
    IntensityFactors factors;
  };


  /// The cracks of a state.
  struct CrackSample
  {
    /// All crack tips, in the order of tips.csv.
    std::vector<TipSample> tips;
    /// Start and end of each straight increment by which a crack has grown [m].
    std::vector<std::pair<dealii::Point<2>, dealii::Point<2>>> increments;
  };


  /**
   * Writes tips to the VTU file @p name for ParaView: points with the scalars K_I, K_II, T and
   * energy_release_rate, and with the vectors direction and displacement, all in single precision.
   * If there is no tip, the file has no points; ParaView shows nothing then. For use on one rank.
   */
  void
  write_tips(const std::vector<TipSample> &tips,
             const OutputDirectory        &directory,
             const std::string            &name);


  /**
   * Marks cracks in a picture: adds the tips, and moves those outlines that lie on increments to
   * PictureData::grown_faces. Both faces of a crack are outlines, with the displacements of their
   * sides. Cost: O(outlines · increments). For use on the rank that holds the picture.
   */
  void
  add_cracks(const CrackSample &cracks, PictureData &data);
} // namespace NMM

#endif
