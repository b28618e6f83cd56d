#include <nmm/contact/chosen_parameters.h>
#include <nmm/contact/diagnostics/locked_corners.h>
#include <nmm/contact/surface/initial_stress.h>
#include <nmm/covers/crack_tip.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <set>
#include <utility>

namespace NMM
{
  std::vector<double>
  block_moduli(const PhysicalMesh &mesh, const ElasticityProblem &problem)
  {
    const std::vector<unsigned int> region_to_material =
      problem.region_to_material(mesh);
    std::vector<double> moduli(mesh.n_blocks(), 0.);
    for (unsigned int r = 0; r < mesh.regions().size(); ++r)
    {
      double &modulus = moduli[mesh.regions()[r].block];
      modulus =
        std::max(modulus,
                 problem.materials[region_to_material[r]].youngs_modulus);
    }
    return moduli;
  }


  ContactChoices::MakeLaw
  coulomb_friction(const double friction, const double cohesion)
  {
    return [friction, cohesion](const ContactLaw &springs) {
      auto law              = std::make_shared<CoulombLaw>();
      law->normal_stiffness = springs.normal_stiffness;
      law->shear_stiffness  = springs.shear_stiffness;
      law->friction         = friction;
      law->cohesion         = cohesion;
      return law;
    };
  }


  namespace
  {
    /// Rank of each value in ascending order, from 0 on; equal values have equal ranks.
    std::vector<unsigned int>
    ranks(const std::vector<double> &values)
    {
      const std::set<double>    steps(values.begin(), values.end());
      std::vector<unsigned int> result;
      for (const double value : values)
        result.push_back(std::distance(steps.begin(), steps.find(value)));
      return result;
    }


    /// The size of cells at faces [m] below which a twentieth of the faces lies by their length, or a
    /// tenth by their number of edges; an edge is in one cell. Slivers are left out, since their cells can be
    /// as thin as they are, unless all regions are slivers.
    double
    smaller_cell_size(const ContactSurface &surface, const bool is_by_length)
    {
      const ManifoldMesh &mesh    = surface.cover_system().manifold_mesh();
      const auto         &regions = mesh.physical_mesh().regions();
      const bool          with_slivers =
        std::all_of(regions.begin(), regions.end(), [](const auto &region) {
          return region.is_sliver;
        });
      std::vector<std::pair<double, double>> sizes;
      double                                 sum = 0.;
      for (unsigned int e = 0; e < surface.edges().size(); ++e)
      {
        const auto &edge = surface.edges()[e];
        if (surface.is_rigid(e) ||
            (!with_slivers && regions[mesh.region(edge.element)].is_sliver))
          continue;
        // The size is the edge length of the equilateral triangle with the same area.
        const double twice_area =
          1. / std::abs(dealii::determinant(edge.inverse));
        const double weight = is_by_length ? edge.start.distance(edge.end) : 1.;
        sizes.emplace_back(std::sqrt(2. * twice_area / std::sqrt(3.)), weight);
        sum += weight;
      }
      Assert(!sizes.empty(), dealii::ExcMessage("A solid has a boundary."));
      std::sort(sizes.begin(), sizes.end());
      double left = (is_by_length ? 0.05 : 0.1) * sum;
      auto   size = sizes.begin();
      while (left >= size->second && size + 1 != sizes.end())
        left -= (size++)->second;
      return size->first;
    }


    /// Cracks with tips towards which the mesh is graded.
    struct FineCracks
    {
      FineCracks() = default;

      explicit FineCracks(const PhysicalMesh &mesh)
      {
        for (const CrackTip &tip : find_crack_tips(mesh))
        {
          shortest = std::min(shortest, tip.free_radius);
          names.insert(mesh.curves()[tip.curve].name);
        }
      }

      /// The cell size [m] that the stiffness of springs between their faces follows. Cells at tips
      /// are up to a million times smaller than the crack; with springs as stiff as such cells the
      /// pressure oscillates. With a stiffness of 30 E / (0.003 R), the intensity factors of a closed
      /// crack of length R are wrong by less than 1e-4.
      double
      cell_size(const ContactSurface &surface) const
      {
        return std::max(smaller_cell_size(surface, /* is_by_length = */ false),
                        3e-3 * shortest);
      }

      std::set<std::string> names;
      /// The smallest free radius of a tip [m].
      double shortest = std::numeric_limits<double>::max();
    };


    /// The law of faces in general, with springs for cells of the size @p cell_size [m].
    std::shared_ptr<const ContactLaw>
    make_law(const ContactChoices &choices,
             const double          modulus,
             const double          cell_size,
             const bool            has_cracks)
    {
      // The penalty method needs stiff springs to be accurate, which a static
      // analysis allows. Stiff shear springs prevent Newton's method from
      // deciding between stick and slip in a static analysis; with soft ones in dynamics, faces that
      // lose contact repeatedly slide too far. A spring at a vertex represents the length of a
      // cell, which does not enter its stiffness.
      const bool is_stiff =
        !choices.has_multipliers && choices.use == ContactUse::statics;
      const double length =
        choices.values.integration == ContactIntegration::points ? 1.
                                                                 : cell_size;
      CoulombLaw springs;
      springs.normal_stiffness = (is_stiff ? 30. : 10.) * modulus / length;
      springs.shear_stiffness =
        has_cracks
          ? springs.normal_stiffness
          : (choices.use == ContactUse::motion ? 10. : 1.) * modulus / length;
      return choices.law ? choices.law(springs)
                         : std::make_shared<CoulombLaw>(springs);
    }
  } // namespace


  ContactParameters
  choose_contact_parameters(const ContactSurface    &surface,
                            const ElasticityProblem &problem,
                            const ContactChoices    &choices)
  {
    const double        size = contact_cell_size(surface);
    const PhysicalMesh &mesh =
      surface.cover_system().manifold_mesh().physical_mesh();
    const FineCracks cracks =
      choices.has_graded_tips ? FineCracks(mesh) : FineCracks();
    const double fine_size =
      cracks.names.empty() ? size : std::min(size, cracks.cell_size(surface));
    const std::vector<double> moduli = block_moduli(mesh, problem);
    const auto                law_of = [&](const double cell_size) {
      return make_law(choices,
                      *std::min_element(moduli.begin(), moduli.end()),
                      cell_size,
                      !cracks.names.empty());
    };
    const auto may_be_crack = [&](const std::string &name) {
      return name.empty() || cracks.names.count(name) > 0;
    };
    ContactParameters parameters = choices.values;
    parameters.law               = law_of(size);
    const auto law_of_cracks     = law_of(fine_size);
    parameters.pairs.clear();
    for (const ContactChoices::Pair &pair : choices.pairs)
      parameters.pairs.push_back(
        {pair.first,
         pair.second,
         pair.law(may_be_crack(pair.first) && may_be_crack(pair.second)
                    ? *law_of_cracks
                    : *parameters.law)});
    // the first law that fits holds
    for (const std::string &crack : cracks.names)
      parameters.pairs.push_back({crack, crack, law_of_cracks});
    if (choices.has_multipliers && parameters.penetration_tolerance == 0.)
      parameters.penetration_tolerance = 1e-5 * fine_size;
    parameters.slave_priority  = ranks(moduli);
    parameters.initial_stress  = initial_stress_at_faces(surface, problem);
    parameters.rounded_corners = find_locked_corners(surface, choices.gravity);
    // A block that moves further than a trial of the factor of safety allows does not stand. Elsewhere
    // the rounding is a small part of what the mesh resolves.
    constexpr double further = 1.5, of_cell = 0.01;
    if (parameters.corner_rounding == 0.)
      parameters.corner_rounding = choices.way_at_corners > 0.
                                     ? further * choices.way_at_corners
                                     : of_cell * size;
    return parameters;
  }


  double
  contact_cell_size(const ContactSurface &surface)
  {
    return smaller_cell_size(surface, /* is_by_length = */ true);
  }
} // namespace NMM
