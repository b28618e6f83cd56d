#ifndef nmm_mechanics_solid_h
#define nmm_mechanics_solid_h

#include <nmm/covers/aggregation.h>
#include <nmm/covers/cover_system.h>
#include <nmm/covers/own_meshes.h>
#include <nmm/quadrature/element_quadrature.h>

#include <deal.II/lac/affine_constraints.h>

#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace NMM
{
  /// How a Solid is made from curves and a mathematical mesh.
  struct SolidParameters
  {
    /// The treatment of covers with little support.
    Stabilization stabilization = Stabilization::aggregation;
    /// Least element_support() of an element without such treatment [-].
    double threshold = default_aggregation_threshold;
    /// Which regions get meshes of their own; OwnMeshParameters::threshold is replaced by
    /// `threshold`.
    OwnMeshParameters own_meshes;
    /// Degree for which the rules are exact; 0: 2p for weight functions of the degree p, which is
    /// enough for masses, for finite strains and for loads that vary. Small displacements need
    /// 2p - 2, and the degree of the loads.
    unsigned int quadrature_degree = 0;
    /// Whether faces may touch. On several ranks contact needs the covers at all of them.
    bool may_touch = true;
    /// Called at the beginning of each stage with its name ("cutting", "covers", "quadrature");
    /// what it returns lives until the end of the stage.
    std::function<std::shared_ptr<void>(const std::string &stage)> begin_stage;
  };


  /**
   * A solid, cut once: everything that follows from its curves and a mathematical mesh, in the
   * order of the method. Curves bound blocks (PhysicalMesh); they cut triangles into manifold
   * elements (ManifoldMesh), whose connected pieces about a node are the physical covers
   * (CoverSystem), with two unknowns each; covers with little support depend on others
   * (Aggregation); and each element has a quadrature rule. All parts live in the reference
   * configuration, and none of them changes any more.
   *
   * Materials, loads and supports are in an ElasticityProblem, since one solid can have many.
   */
  class Solid
  {
  public:
    /// Cut @p mathematical_mesh by the curves of @p physical_mesh. Collective.
    /// @throws InputError as make_own_meshes().
    Solid(std::shared_ptr<const PhysicalMesh> physical_mesh,
          std::unique_ptr<MathematicalMesh>   mathematical_mesh,
          MPI_Comm                            communicator,
          const SolidParameters              &parameters = {});

    /// The same for a regular mesh of six-node triangles, see make_regular_mesh(), over the solid
    /// that is bounded by the curves of @p geometry.
    /// @throws InputError also for curves that bound no solid.
    Solid(Geometry                     geometry,
          const RegularMeshParameters &mesh,
          MPI_Comm                     communicator,
          const SolidParameters       &parameters = {});

    Solid(const Solid &) = delete;
    Solid &
    operator=(const Solid &) = delete;

    /// Blocks, regions and curves.
    const PhysicalMesh &
    physical_mesh() const
    {
      return *blocks;
    }

    /// The triangles and their weight functions.
    const MathematicalMesh &
    mathematical_mesh() const
    {
      return *meshes.mathematical_mesh;
    }

    /// The triangles, cut by the curves.
    const ManifoldMesh &
    manifold_mesh() const
    {
      return *meshes.manifold_mesh;
    }

    /// The physical covers.
    const CoverSystem &
    covers() const
    {
      return *cover_system;
    }

    /// The covers that depend on others.
    const Aggregation &
    aggregation() const
    {
      return aggregated;
    }

    /// That dependence for two displacements per cover.
    const dealii::AffineConstraints<double> &
    constraints() const
    {
      return dependence;
    }

    /// Null unless SolidParameters::stabilization asks for it.
    const GhostPenalty *
    ghost_penalty() const
    {
      return penalty.get();
    }

    /// The rules of the elements of this rank.
    const QuadratureCollection &
    quadrature() const
    {
      return *rules;
    }

    /// Degree for which these rules are exact.
    unsigned int
    quadrature_degree() const
    {
      return degree_of_rules;
    }

    /// An element that contains the point @p x [m], and the point in the reference coordinates of its cell.
    /// @throws InputError for a point outside of the solid.
    std::pair<unsigned int, dealii::Point<2>>
    locate(const dealii::Point<2> &x) const;

    /// Sentences for the user: which regions got which mesh.
    const std::vector<std::string> &
    notices() const
    {
      return meshes.notices;
    }

  private:
    Solid(const std::shared_ptr<const PhysicalMesh> &physical_mesh,
          const RegularMeshParameters               &mesh,
          MPI_Comm                                   communicator,
          const SolidParameters                     &parameters);

    // Each object refers to those above it.
    std::shared_ptr<const PhysicalMesh>   blocks;
    OwnMeshes                             meshes;
    std::unique_ptr<CoverSystem>          cover_system;
    Aggregation                           aggregated;
    dealii::AffineConstraints<double>     dependence;
    std::unique_ptr<GhostPenalty>         penalty;
    unsigned int                          degree_of_rules;
    std::unique_ptr<QuadratureCollection> rules;
  };
} // namespace NMM

#endif
