#ifndef nmm_fracture_crack_start_h
#define nmm_fracture_crack_start_h

#include <nmm/covers/cover_system.h>
#include <nmm/mechanics/elasticity_problem.h>

#include <functional>
#include <vector>

namespace NMM
{
  /// A place at a boundary or hole where a crack may start.
  struct CrackStart
  {
    /// The place, up to rounding on the boundary [m].
    dealii::Point<2> point;
    /// Unit vector along which the crack starts, into the solid [-].
    dealii::Tensor<1, 2> direction;
    /// Region of the physical mesh at the place.
    unsigned int region = invalid_index;
    /// Mean stress across the line of the crack, see find_crack_starts() [Pa].
    double mean_stress = 0.;
    /// The mean stress over the fracture strength of the material [-]; a crack starts at 1.
    double drive = 0.;
  };


  /// In-plane stress [Pa], a function of the element and of reference coordinates in its cell [-].
  using ElementStress =
    std::function<dealii::SymmetricTensor<2, 2>(unsigned int,
                                                const dealii::Point<2> &)>;


  /**
   * The length over which stress is averaged where a crack may start,
   * @f$ L = \frac{2}{\pi}\left(\frac{K_c}{f_t}\right)^2 @f$ [m], from the toughness K_c and the
   * fracture strength f_t, both of which must be positive.
   */
  double
  averaging_length(const Material &material);


  /**
   * The places at boundaries and holes where cracks are most likely to start, with the largest
   * drive first.
   *
   * A crack starts at the point x of a boundary in the direction d, with the unit normal n, where
   * @f[ \frac1L\int_0^L n\cdot\sigma(x+sd)\,n\,ds = f_t. @f]
   * The stress at a point decides nothing, since it is infinite in the corner of a notch. The mean
   * is finite there, and the length L, see averaging_length(), is the one for which the
   * criterion agrees with the toughness: ahead of the tip of a crack with K_I = K_c and K_II = 0
   * the mean over L is f_t. Source: D. Taylor, The theory of critical distances (2007), line
   * method; V. Novozhilov, J. Appl. Math. Mech. 33 (1969), 201-210.
   *
   * At three points of each edge of an element on a boundary, the mean stress along the
   * inward normal is computed first. Where it is largest, the point is moved along its edge, and
   * the line is turned until the mean stress across it is largest. Materials without a fracture
   * strength, boundaries on which the displacement is prescribed, and lines that leave the block
   * or meet a joint are left out, and those that run along the boundary from which they
   * start. Of places nearer to each other than @p spacing [m], only the
   * one with the largest drive is returned, and none with less than 0.8 of the largest drive, nor
   * within this distance of the places @p taken.
   *
   * On several ranks each finds all places, and @p stress has to know all elements on each of them, as
   * that of DisplacementField::on_all_ranks() does.
   *
   * Limits: joints, interfaces and sides that two domains share are no places to start
   * from, unless they end at a boundary. Lines of less than a cell see the stress of a single
   * cell; in the corner of a notch this needs cells that are smaller than L.
   */
  std::vector<CrackStart>
  find_crack_starts(const CoverSystem                   &covers,
                    const ElasticityProblem             &problem,
                    const ElementStress                 &stress,
                    double                               spacing,
                    const std::vector<dealii::Point<2>> &taken = {});
} // namespace NMM

#endif
