#include <nmm/base/exceptions.h>
#include <nmm/base/memory.h>
#include <nmm/covers/element_support.h>
#include <nmm/covers/own_meshes.h>
#include <nmm/covers/point_location.h>

#include "cutting.h"
#include "fitted_mesh.h"
#include "parts_to_cut.h"
#include <algorithm>
#include <cmath>
#include <iomanip>
#include <map>
#include <sstream>

namespace NMM
{
  using namespace dealii;

  namespace
  {
    /// How well a region's elements fill the cells of a mesh.
    struct Filling
    {
      /// Largest ratio of an element's area to that of its cell [-].
      double best = 0.;
      /// Longest edge of that element's cell [m].
      double cell_size = 0.;
    };


    /// Relative rounding of sizes and shares. It is larger than that of a metre in a national grid,
    /// whose coordinates are rounded to 1e-9 m.
    constexpr double rounding = 1e-6;


    void
    take_better(Filling                &filling,
                const double            share,
                const MathematicalMesh &mesh,
                const unsigned int      cell)
    {
      if (share > (1. + rounding) * filling.best || filling.cell_size == 0.)
        filling = {share, mesh.cell_diameter(cell)};
    }


    std::vector<Filling>
    measure(const ManifoldMesh &manifold_mesh)
    {
      const MathematicalMesh &mesh = manifold_mesh.mathematical_mesh();
      std::vector<Filling>    fillings(
        manifold_mesh.physical_mesh().regions().size());
      for (unsigned int e = 0; e < manifold_mesh.n_elements(); ++e)
      {
        const unsigned int cell = manifold_mesh.cell(e);
        take_better(fillings[manifold_mesh.region(e)],
                    element_support(manifold_mesh, e),
                    mesh,
                    cell);
      }
      return fillings;
    }


    /// Kind of mesh that a region has got.
    enum class Outcome
    {
      main_mesh,
      single_triangle,
      row,
      rectangles,
      badly_filled
    };


    struct FittedMesh
    {
      MeshPart mesh;
      Outcome  outcome = Outcome::main_mesh;
      Filling  filling;
    };


    /// Finds meshes for regions, one after the other.
    class Fitter
    {
    public:
      Fitter(const PhysicalMesh      &physical_mesh,
             const OwnMeshParameters &parameters)
        : physical_mesh(physical_mesh)
        , parameters(parameters)
        , edges(physical_mesh)
        , region_to_part(physical_mesh.regions().size(), invalid_index)
      {
      }

      /// Longer side of the bounding rectangle of a region [m].
      double
      longer_side(unsigned int region) const
      {
        return internal::RegionShape(edges, region).sides[0];
      }

      /// Find a mesh for @p region; @p on_main_mesh tells how well it fills cells of the main mesh.
      FittedMesh
      fit(unsigned int      region,
          const Filling    &on_main_mesh,
          const RegionMesh &choice);

      /// Number of cells that a region's own mesh is to have; 0 if the user does not give it.
      double
      n_cells_wanted(unsigned int region, const RegionMesh &choice) const;

    private:
      /// Find out how well the region fills cells of @p mesh, by cutting that mesh with it alone.
      Filling
      measure(unsigned int                 region,
              const internal::RegionShape &shape,
              const MeshPart              &mesh);

      const PhysicalMesh           &physical_mesh;
      const OwnMeshParameters      &parameters;
      const internal::PhysicalEdges edges;
      /// Only the current region is on part 0.
      std::vector<unsigned int> region_to_part;
    };


    Filling
    Fitter::measure(const unsigned int           region,
                    const internal::RegionShape &shape,
                    const MeshPart              &mesh)
    {
      const double area = physical_mesh.regions()[region].area;
      const double mean = area / internal::mesh_area(mesh);
      // A convex region is connected in each cell, and some cell is filled at least as well as the
      // average.
      const bool is_convex = area >= 0.999 * shape.inner_hull_area;
      Filling    filling;
      if (mesh.cells.size() == 1 ||
          (is_convex && mean >= 1.01 * parameters.filling))
      {
        filling.best  = mean;
        const auto &v = mesh.cells[0];
        for (unsigned int i = 0; i < 3; ++i)
          filling.cell_size = std::max(filling.cell_size,
                                       mesh.vertices[v[i]].distance(
                                         mesh.vertices[v[(i + 1) % 3]]));
        return filling;
      }

      const MathematicalMesh     mathematical_mesh = combine_meshes({mesh}, 1);
      const auto                 around            = edges.region_edges(region);
      const internal::PartToCut  part              = {&mathematical_mesh,
                                                      &physical_mesh,
                                                      &edges,
                                                      &region_to_part,
                                                      Cutter::cell_by_cell,
                                                      0,
                                                      {0, mathematical_mesh.n_cells()},
                                                      {around.begin(), around.end()}};
      const auto                &cells             = mathematical_mesh.cells();
      std::vector<unsigned char> state(cells.size(),
                                       internal::CellState::untouched);
      internal::Cutting          cutting;
      cutting.cell_region.assign(cells.size(), invalid_index);
      cutting.is_met.assign(edges.edges().size(), 0);
      region_to_part[region] = 0;
      internal::cut(part,
                    internal::find_neighbors(mathematical_mesh),
                    internal::find_near_edges(part, shape.scale),
                    state,
                    cutting);
      region_to_part[region] = invalid_index;

      for (unsigned int i = 0; i < cutting.elements.size(); ++i)
      {
        const unsigned int c = cutting.elements[i].cell;
        take_better(filling,
                    internal::element_area(cutting, i) /
                      mathematical_mesh.cell_area(c),
                    mathematical_mesh,
                    c);
      }
      for (unsigned int c = 0; c < cells.size(); ++c)
        if (cutting.cell_region[c] != invalid_index)
          take_better(filling, 1., mathematical_mesh, c);
      return filling;
    }


    FittedMesh
    Fitter::fit(const unsigned int region,
                const Filling     &on_main_mesh,
                const RegionMesh  &choice)
    {
      const internal::RegionShape shape(edges, region);
      const bool   if_better = choice.kind == RegionMesh::Kind::where_needed;
      const double h         = choice.n_across > 0
                                 ? (1. + rounding) * shape.sides[0] / choice.n_across
                                 : on_main_mesh.cell_size;
      FittedMesh   best;
      const auto   try_mesh = [&](MeshPart &&mesh, const Outcome outcome) {
        const Filling filling = measure(region, shape, mesh);
        if (filling.best > best.filling.best)
          best = {std::move(mesh), outcome, filling};
        return best.filling.best >= parameters.filling;
      };

      if (shape.sides[0] <= (1. + rounding) * h &&
          try_mesh(internal::make_single_triangle(shape),
                   Outcome::single_triangle))
        return best;

      std::array<unsigned int, 2> n;
      for (unsigned int d = 0; d < 2; ++d)
        n[d] = static_cast<unsigned int>(
          std::clamp(std::ceil((1. - rounding) * shape.sides[d] / h),
                     1.,
                     static_cast<double>(parameters.n_cells_at_most)));
      unsigned int first_level = 0;
      if (n[1] > 1 && if_better)
      {
        // Cells of the main mesh's size have been tried before.
        first_level = 1;
        for (unsigned int &count : n)
          count *= 2;
      }
      for (unsigned int level = first_level; level <= parameters.n_halvings;
           ++level)
      {
        const bool too_many  = 2. * n[0] * n[1] > parameters.n_cells_at_most;
        const bool too_small = shape.sides[1] < 40. * shape.rounding * n[1];
        if (level > 0 && (too_many || too_small))
          break;
        if (try_mesh(internal::make_rectangles(shape, n),
                     n[1] == 1 ? Outcome::row : Outcome::rectangles))
          return best;
        for (unsigned int &count : n)
          count *= 2;
      }

      if (if_better && best.filling.best <= 2. * on_main_mesh.best)
        return {};
      best.outcome = Outcome::badly_filled;
      return best;
    }


    double
    Fitter::n_cells_wanted(const unsigned int region,
                           const RegionMesh  &choice) const
    {
      if (choice.n_across == 0)
        return 0.;
      const internal::RegionShape shape(edges, region);
      const double                n = choice.n_across;
      return 2. * n *
             std::ceil((1. - rounding) * n * shape.sides[1] / shape.sides[0]);
    }


    /// @throws InputError if there is not enough memory for the cells that regions are to have.
    void
    check_memory(const Fitter                    &fitter,
                 const std::vector<unsigned int> &needy,
                 const std::vector<RegionMesh>   &choices,
                 const OwnMeshParameters         &parameters)
    {
      double n_cells = 0.;
      for (const unsigned int r : needy)
        n_cells += fitter.n_cells_wanted(r, choices[r]);
      std::ostringstream number;
      number << std::setprecision(2) << n_cells
             << " cells of blocks' own meshes";
      require_memory(parameters.memory_per_cell * n_cells,
                     available_memory(1u),
                     number.str(),
                     "the number of cells across blocks",
                     [](const double excess) {
                       std::ostringstream text;
                       text
                         << std::setprecision(2) << "divide it by "
                         << 1.05 * std::sqrt(excess)
                         << ", or choose a machine or limit with more memory";
                       return text.str();
                     });
    }


    /// Regions with the same kind of mesh, which one notice reports.
    struct Group
    {
      unsigned int n_regions = 0, n_cells = 0;
      unsigned int worst         = invalid_index;
      double       worst_filling = 1e300;
    };


    /// Beginning of a notice: "The region around (x, y) (area ...) has ..." or "12 regions have
    /// ...".
    std::string
    describe(const Outcome               outcome,
             const Group                &group,
             const PhysicalMesh::Region &region,
             const OwnMeshParameters    &parameters)
    {
      const bool         one = group.n_regions == 1;
      std::ostringstream example, text;
      example << std::setprecision(3) << "the region around "
              << to_string(region.inside) << " (area " << region.area
              << " m^2)";
      text << std::setprecision(3)
           << (one ? example.str()
                   : std::to_string(group.n_regions) + " regions");
      if (outcome == Outcome::main_mesh || outcome == Outcome::badly_filled)
        text << (one ? " fills" : " fill")
             << " no triangle of any mesh tried to the threshold of "
             << parameters.filling << " and "
             << (outcome == Outcome::main_mesh
                   ? (one ? "stays on" : "stay on")
                   : (one ? "has the best of these instead of"
                          : "have the best of these instead of"))
             << " the main mathematical mesh; the system is less well "
                "conditioned for that";
      else
        text << (one ? " has" : " have each")
             << " a mathematical mesh of the region's own size: "
             << (outcome == Outcome::single_triangle ? "one triangle"
                 : outcome == Outcome::row ? "one row of halved rectangles"
                                           : "halved rectangles");
      text << " (";
      if (group.n_cells > 0)
        text << group.n_cells << (group.n_cells == 1 ? " cell, " : " cells, ");
      text << "filled to " << 100. * group.worst_filling << " %"
           << (one ? ")" : " or more)");
      if (!one)
        text << ", the least so " << example.str();
      return text.str();
    }


    std::vector<RegionMesh>
    region_meshes(const OwnMeshParameters &parameters,
                  const std::size_t        n_regions)
    {
      using Kind = RegionMesh::Kind;
      if (parameters.regions.empty())
        return std::vector<RegionMesh>(
          n_regions,
          {parameters.every_region ? Kind::own : Kind::where_needed, 0});
      AssertThrow(parameters.regions.size() == n_regions,
                  InputError(std::to_string(parameters.regions.size()) +
                               " choices of a mathematical mesh",
                             std::to_string(n_regions) + " regions",
                             "give one for each region, or none"));
      for (const RegionMesh &choice : parameters.regions)
        AssertThrow(choice.n_across > 0 || choice.kind != Kind::automatic,
                    InputError("no number of cells across a region",
                               "the choice of its mathematical mesh",
                               "give at least 1 for an automatic choice"));
      return parameters.regions;
    }


    MathematicalMesh
    combine(const MathematicalMesh &main_mesh, std::vector<MeshPart> &parts)
    {
      parts[0] = make_mesh_part(main_mesh);
      return combine_meshes(parts, main_mesh.degree());
    }
  } // namespace


  OwnMeshes
  make_own_meshes(std::unique_ptr<MathematicalMesh> main_mesh,
                  const PhysicalMesh               &physical_mesh,
                  const OwnMeshParameters          &parameters)
  {
    Assert(main_mesh->n_parts() == 1, ExcInternalError());
    OwnMeshes result;
    result.manifold_mesh =
      std::make_unique<ManifoldMesh>(*main_mesh, physical_mesh);
    result.mathematical_mesh               = std::move(main_mesh);
    const std::vector<Filling>    fillings = measure(*result.manifold_mesh);
    const std::vector<RegionMesh> choices =
      region_meshes(parameters, fillings.size());
    // Most meshes need no fitter.
    std::unique_ptr<Fitter> fitter;
    const auto              make_fitter = [&]() -> Fitter              &{
      if (fitter == nullptr)
        fitter = std::make_unique<Fitter>(physical_mesh, parameters);
      return *fitter;
    };
    const auto wants_own = [&](const unsigned int region) {
      using Kind                = RegionMesh::Kind;
      const RegionMesh &choice  = choices[region];
      const Filling    &filling = fillings[region];
      if (choice.kind == Kind::main_mesh || choice.kind == Kind::own)
        return choice.kind == Kind::own;
      return filling.best < parameters.threshold ||
             (choice.kind == Kind::automatic &&
              filling.cell_size * choice.n_across >
                (1. + rounding) * make_fitter().longer_side(region));
    };
    std::vector<unsigned int> needy;
    for (unsigned int r = 0; r < fillings.size(); ++r)
      if (wants_own(r))
        needy.push_back(r);
    if (needy.empty())
      return result;

    check_memory(make_fitter(), needy, choices, parameters);
    std::vector<MeshPart>    parts(1);
    std::map<Outcome, Group> groups;
    result.region_to_part.assign(fillings.size(), 0);
    for (const unsigned int r : needy)
    {
      FittedMesh fitted = make_fitter().fit(r, fillings[r], choices[r]);
      Group     &group  = groups[fitted.outcome];
      ++group.n_regions;
      group.n_cells += fitted.mesh.cells.size();
      const double filling =
        fitted.mesh.cells.empty() ? fillings[r].best : fitted.filling.best;
      if (group.worst == invalid_index || filling < group.worst_filling)
      {
        group.worst         = r;
        group.worst_filling = filling;
      }
      if (fitted.mesh.cells.empty())
        continue;
      result.region_to_part[r] = parts.size();
      parts.push_back(std::move(fitted.mesh));
    }
    for (const auto &[outcome, group] : groups)
      result.notices.push_back(describe(
        outcome, group, physical_mesh.regions()[group.worst], parameters));
    if (parts.size() == 1)
    {
      result.region_to_part.clear();
      return result;
    }

    auto combined = std::make_unique<MathematicalMesh>(
      combine(*result.mathematical_mesh, parts));
    result.manifold_mesh =
      std::make_unique<ManifoldMesh>(*combined,
                                     physical_mesh,
                                     result.region_to_part);
    result.mathematical_mesh = std::move(combined);
    return result;
  }


  unsigned int
  find_region(const PhysicalMesh &physical_mesh, const Point<2> &x)
  {
    const internal::PhysicalEdges edges(physical_mesh);
    for (unsigned int r = 0; r < physical_mesh.regions().size(); ++r)
    {
      std::vector<ElementEdge> around;
      for (const unsigned int e : edges.region_edges(r))
      {
        // Curves that end inside the region do not count.
        const auto &sides = edges.edges()[e].regions;
        if (sides[0] != sides[1])
          around.push_back(edges.edges()[e].shape);
      }
      if (is_inside({around.data(), around.size()}, x))
        return r;
    }
    return invalid_index;
  }


  double
  largest_extent(const PhysicalMesh &physical_mesh)
  {
    const internal::PhysicalEdges edges(physical_mesh);
    double                        largest = 0.;
    for (unsigned int r = 0; r < physical_mesh.regions().size(); ++r)
      largest = std::max(largest, internal::RegionShape(edges, r).sides[0]);
    return largest;
  }
} // namespace NMM
