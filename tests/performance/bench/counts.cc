#include "counts.h"

#include <nmm/base/exceptions.h>
#include <nmm/contact/assembly/statics.h>
#include <nmm/covers/own_meshes.h>
#include <nmm/quadrature/element_values.h>
#include <nmm/quadrature/joint_values.h>

#include <deal.II/fe/fe_system.h>

#include "report.h"
#include "staged_model.h"
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <support/coulomb.h>

namespace NMM
{
  namespace Bench
  {
    namespace
    {
      using Type = BoundaryCondition::Type;


      /// Collects counts of allocations.
      class Counter
      {
      public:
        /// @p n: how many of @p per the action is for.
        template <typename Action>
        void
        count(const std::string &what,
              const std::string &per,
              const double       n,
              const Action      &action)
        {
          const unsigned long before = n_allocations();
          action();
          const double calls = n_allocations() - before;
          counts.push_back({"allocations", what, per, n, calls / n});
        }

        std::vector<Count> counts;
      };


      Row unused_row;


      /// Blocks between two sets of joints, each with a mesh of its own.
      void
      count_cutting(Counter &counter)
      {
        Geometry geometry;
        add_box(geometry, {0., 0.}, {1., 1.});
        for (unsigned int i = 1; i < 10; ++i)
        {
          const double x = 0.1 * i - 0.02;
          geometry.add_polyline({{-0.1, x}, {1.1, x + 0.05}},
                                "flat joint " + std::to_string(i),
                                CurveRole::joint);
          geometry.add_polyline({{x, -0.1}, {x + 0.05, 1.1}},
                                "steep joint " + std::to_string(i),
                                CurveRole::joint);
        }
        const PhysicalMesh    physical(std::move(geometry));
        RegularMeshParameters mesh;
        mesh.cell_size = 0.5;
        for (const unsigned int n_across : {1U, 3U})
        {
          OwnMeshParameters own;
          own.regions.assign(physical.regions().size(),
                             {RegionMesh::Kind::own, n_across});
          const OwnMeshes meshes =
            make_own_meshes(std::make_unique<MathematicalMesh>(
                              make_regular_mesh(physical, mesh, 2)),
                            physical,
                            own);
          counter.count("cutting of blocks' own meshes, " +
                          std::to_string(n_across) + " across",
                        "cut cell",
                        meshes.manifold_mesh->n_cells_cut_exactly(),
                        [&]() {
                          const ManifoldMesh cut(*meshes.mathematical_mesh,
                                                 physical,
                                                 meshes.region_to_part);
                        });
        }
      }


      /// A square with a few joints, of one material.
      std::unique_ptr<StagedModel>
      make_square()
      {
        Geometry geometry;
        add_box(geometry, {0., 0.}, {1., 1.});
        for (unsigned int i = 1; i < 5; ++i)
          geometry.add_polyline({{0.1, 0.2 * i}, {0.9, 0.2 * i + 0.05}},
                                "joint " + std::to_string(i),
                                CurveRole::joint);
        GradedMeshParameters mesh;
        mesh.cell_size = 0.02;
        mesh.rotation  = 7.;
        auto model     = std::make_unique<StagedModel>(std::move(geometry),
                                                   mesh,
                                                   StagedModel::Options(),
                                                   unused_row);
        model->problem.plane_state = PlaneState::plane_strain;
        model->problem.materials   = {material("rock", 1e7, 0.2, 2500.)};
        model->problem.gravity     = Tensor<1, 2>({0., -9.81});
        model->problem.boundary_conditions = {
          condition(Type::displacement, "bottom")};
        return model;
      }


      /// Values in all elements, and on both sides of all joints.
      void
      count_values(const StagedModel &model, Counter &counter)
      {
        const dealii::FESystem<2> fe(model.mathematical_mesh->fe(), 2);
        const dealii::UpdateFlags flags =
          dealii::update_values | dealii::update_gradients |
          dealii::update_quadrature_points | dealii::update_JxW_values;
        ElementValues values(*model.covers, *model.quadrature, fe, flags);
        JointValues   joint(*model.covers, 4, fe, flags);
        const auto    pieces   = joint_pieces(*model.covers);
        const auto    elements = [&]() {
          for (unsigned int e = 0; e < model.manifold_mesh->n_elements(); ++e)
            values.reinit(e);
        };
        const auto joints = [&]() {
          for (const EdgePiece &piece : pieces)
            joint.reinit(piece);
        };
        // the first ones make the memory that is used again
        elements();
        joints();
        counter.count("values in elements",
                      "element",
                      model.manifold_mesh->n_elements(),
                      elements);
        counter.count("values on joints", "piece", pieces.size(), joints);
      }


      void
      count_volume(Counter &counter)
      {
        const auto          model_made = make_square();
        StagedModel        &model      = *model_made;
        const ManifoldMesh &mesh       = *model.manifold_mesh;
        const double        n          = mesh.n_elements();
        double              n_cut      = 0.;
        for (unsigned int e = 0; e < mesh.n_elements(); ++e)
          n_cut += mesh.is_whole(e) ? 0. : 1.;
        counter.count("quadrature", "cut element", n_cut, [&]() {
          const QuadratureCollection quadrature(
            mesh, 2, 4, model.covers->locally_owned_elements());
        });
        StaticElasticity system(*model.covers,
                                *model.quadrature,
                                model.constraints,
                                model.problem);
        counter.count("assembly with sparsity pattern, small",
                      "element",
                      n,
                      [&]() { system.assemble(); });

        FiniteElasticity elasticity(*model.covers,
                                    *model.quadrature,
                                    model.constraints,
                                    model.problem,
                                    /* may_float = */ true);
        const Vector     u        = elasticity.initial_solution();
        const auto       assemble = [&](const Tangent tangent) {
          AssertThrow(elasticity.assemble(u, 1., tangent) ==
                        Deformation::admissible,
                      dealii::ExcInternalError());
        };
        // the first one makes the pattern
        assemble(Tangent::consistent);
        counter.count("residual of an iteration, finite", "element", n, [&]() {
          assemble(Tangent::none);
        });
        counter.count("tangent of an iteration, finite", "element", n, [&]() {
          assemble(Tangent::consistent);
        });
        count_values(model, counter);
        const DisplacementField field(*model.covers, model.problem, u);
        counter.count("stress recovery", "element", n, [&]() {
          const StressRecovery recovery(field, model.aggregation);
        });
      }


      /// A block pressed on a plate.
      void
      count_contact(Counter &counter)
      {
        Geometry geometry;
        add_box(geometry, {0., 0.}, {1., 1.});
        GradedMeshParameters mesh;
        mesh.cell_size = 0.03;
        mesh.rotation  = 7.;
        RigidObstacle plate;
        plate.name   = "plate";
        plate.pieces = {CurvePiece::segment({2., 0.}, {-1., 0.})};
        StagedModel::Options options;
        options.has_contact = true;
        options.obstacles   = {plate};
        StagedModel model(std::move(geometry), mesh, options, unused_row);
        model.problem.plane_state         = PlaneState::plane_strain;
        model.problem.materials           = {material("rock", 1e7, 0.2)};
        model.problem.boundary_conditions = {condition(
          Type::displacement, "top", vector_function([](const Point<2> &) {
            return Tensor<1, 2>({0., -1e-3});
          }))};
        FiniteElasticity elasticity(*model.covers,
                                    *model.quadrature,
                                    model.constraints,
                                    model.problem);
        const auto solid = make_solid_at_rest(elasticity, Kinematics::small);
        ContactParameters parameters;
        coulomb(parameters).normal_stiffness = 1e9;
        Contact        contact(*model.surface, model.constraints, parameters);
        ContactStatics statics(*solid, contact);
        double         n_iterations = 0.;
        const unsigned long before  = n_allocations();
        for (const ContactStep &step : statics.run(LoadSteps::equal(1)))
          n_iterations += step.n_iterations + step.n_lost_iterations;
        counter.counts.push_back({"allocations",
                                  "iterations of a step with contact, small, " +
                                    text_of(model.covers->n_covers() * 2.) +
                                    " unknowns",
                                  "iteration",
                                  n_iterations,
                                  (n_allocations() - before) / n_iterations});
        const double n = contact.points().size();
        const Vector u = statics.solution();
        contact.assemble(u, true);
        counter.count("contact search", "contact point", n, [&]() {
          contact.detect(u);
        });
        counter.count("contact terms with tangent", "contact point", n, [&]() {
          contact.assemble(u, true);
        });
      }


      /// "x: y" -> y
      bool
      read_field(const std::string &line,
                 const std::string &name,
                 std::string       &value)
      {
        if (line.compare(0, name.size(), name) != 0)
          return false;
        value = line.substr(name.size());
        return true;
      }
    } // namespace


    std::vector<Count>
    count_allocations()
    {
      Counter counter;
      count_cutting(counter);
      count_volume(counter);
      count_contact(counter);
      return counter.counts;
    }


    std::vector<Count>
    read_instructions(const std::string &directory)
    {
      std::vector<std::filesystem::path> files;
      if (std::filesystem::is_directory(directory))
        for (const auto &entry : std::filesystem::directory_iterator(directory))
          files.push_back(entry.path());
      // numbered in the order of the kernels, without leading zeros
      std::sort(files.begin(), files.end(), [](const auto &a, const auto &b) {
        const std::string x = a.string(), y = b.string();
        return std::make_pair(x.size(), x) < std::make_pair(y.size(), y);
      });
      std::vector<Count> counts;
      for (const auto &file : files)
      {
        // see nmm-kernels: what|for each of what|how many
        std::ifstream in(file);
        std::string   label, total;
        for (std::string line; std::getline(in, line);)
          if (!read_field(line, "desc: Trigger: Client Request: ", label))
            read_field(line, "totals: ", total);
        const std::size_t first = label.find('|'), second = label.rfind('|');
        if (first == std::string::npos || second == first || total.empty())
          continue;
        const double n = std::stod(label.substr(second + 1));
        counts.push_back({"instructions",
                          label.substr(0, first),
                          label.substr(first + 1, second - first - 1),
                          n,
                          std::stod(total) / n});
      }
      return counts;
    }


    void
    write_counts(const std::string &file_name, const std::vector<Count> &counts)
    {
      std::ofstream out(file_name);
      AssertThrow(out,
                  InputError("the counts cannot be written",
                             file_name,
                             "name a file in a folder that exists"));
      out << "kind;what;per;n;count\n";
      for (const Count &c : counts)
        out << c.kind << ';' << c.what << ';' << c.per << ';' << c.n << ';'
            << c.count << '\n';
    }
  } // namespace Bench
} // namespace NMM
