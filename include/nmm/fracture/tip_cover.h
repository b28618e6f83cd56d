#ifndef nmm_fracture_tip_cover_h
#define nmm_fracture_tip_cover_h

#include <nmm/covers/crack_tip.h>
#include <nmm/fracture/tip_field.h>
#include <nmm/geometry/physical_mesh.h>
#include <nmm/mechanics/disk_cover.h>
#include <nmm/mechanics/elasticity_problem.h>

#include <memory>
#include <vector>

namespace NMM
{
  /**
   * A disk cover about a crack tip. Its functions are the terms n = 1 and n = 3 of Williams' series
   * (TipField) for both modes, which grow like r^(1/2) and r^(3/2). What the other covers have to
   * represent then is a quadratic polynomial and terms of r^(5/2) and higher, so that second-order
   * covers keep their full order with cells of any size at the tip: 3 in the displacement, 2 in
   * the stress.
   *
   * The functions are scaled by the radius R, F = R^((1-n)/2) times the term of unit intensity, so
   * that all coefficients are in Pa m^(1/2). The first two are K_I and K_II up to the
   * discretization error; interaction integrals are more accurate.
   *
   * In the disk the crack must be straight, and there may be no other curve, point force
   * or fixed point. At the tip itself stresses are infinite; evaluate() gives those at the distance
   * R / 100 straight ahead.
   */
  class TipCover : public DiskCover
  {
  public:
    /// A cover about a tip with the given radius [m].
    TipCover(const CrackTip        &tip,
             double                 radius,
             const PlaneElasticity &elasticity);

    /// The tip.
    const CrackTip &
    tip() const;

    /// Radius of the disk [m].
    double
    radius() const;

    unsigned int
    n_functions() const override;

    bool
    contains(const dealii::Point<2> &x) const override;

    Value
    evaluate(unsigned int                i,
             const dealii::Point<2>     &x,
             const dealii::Tensor<1, 2> &into_solid) const override;

    /// Integrals over the disk in polar coordinates; loads should be smooth in it.
    std::vector<double>
    work(const Loads &loads) const override;

  private:
    Value
    at(unsigned int i, double r, double theta) const;

    CrackTip              crack_tip;
    double                disk_radius;
    dealii::Tensor<2, 2>  frame;
    std::vector<TipField> fields;
    std::vector<double>   scales;
  };


  /**
   * Covers for those tips of @p solid that have room for one, in the order of find_crack_tips().
   * The radius is 0.8 times the free radius of the tip, but at most 0.9 times the length over
   * which the crack is straight, 0.8 times the distance to point forces and fixed points of
   * @p problem, and 0.45 times the distance to other tips, so that disks do not overlap. A tip where
   * this is less than @p least_radius [m], or less than @p least_share of the free radius [-], has no
   * cover, nor has a tip on an interface. A cover makes intensity factors more accurate however small it is, but spares cells only
   * from a share of about 0.4 on, since the mesh must be graded towards its circle.
   */
  std::vector<std::unique_ptr<TipCover>>
  make_tip_covers(const PhysicalMesh      &solid,
                  const ElasticityProblem &problem,
                  double                   least_radius = 0.,
                  double                   least_share  = 1e-6);


  /// Add the circles of tip covers to the geometry that @p solid was made of, as interfaces
  /// (Curve::is_auxiliary) with the material of the region around the tip.
  void
  add_circles(const std::vector<std::unique_ptr<TipCover>> &covers,
              const PhysicalMesh                           &solid,
              Geometry                                     &geometry);


  /// Whether @p solid has the circle of a cover about the tip.
  bool
  has_tip_cover(const PhysicalMesh &solid, const CrackTip &tip);
} // namespace NMM

#endif
