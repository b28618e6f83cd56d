#include <nmm/base/program.h>
#include <nmm/mechanics/load_values.h>
#include <nmm/output/vtu.h>

#include <algorithm>
#include <exception>
#include <filesystem>
#include <scene/cleaning_report.h>
#include <scene/crack_growth.h>
#include <scene/scene_analysis.h>
#include <sstream>

namespace NMM
{
  namespace internal
  {
    using Stage = Progress::Stage;

    SceneAnalysis::SceneAnalysis(const Scene   &scene,
                                 Progress      &progress,
                                 const MPI_Comm communicator,
                                 std::string    restart)
      : scene(scene)
      , progress(progress)
      , communicator(communicator)
      , restart(std::move(restart))
    {
    }


    void
    SceneAnalysis::build()
    {
      Geometry geometry = scene.make_geometry(&scene_notices);
      cleaning_actions =
        clean(geometry, scene.parameters().geometry.cleaning_tolerance);
      if (scene.parameters().fracture.n_increments > 0)
        this->geometry = geometry;
      const std::vector<Increment> increments = earlier_increments();
      if (!increments.empty())
      {
        replay(increments);
        // Tips that have grown may be near other curves, or gone.
        build(this->geometry);
        return;
      }
      build(std::move(geometry));
      if (crack_tips)
        crack_tips->check();
    }


    void
    SceneAnalysis::replay(const std::vector<Increment> &increments)
    {
      for (auto next = increments.begin(); next != increments.end();)
      {
        clear();
        make_physical_mesh(geometry);
        keep_geometry();
        for (const unsigned int step = next->step;
             next != increments.end() && next->step == step;
             ++next)
          AssertThrow(next->advance.extend(geometry).end == next->end,
                      InputError("The crack that has grown to " +
                                   to_string(next->end) +
                                   " before the checkpoint ends elsewhere now",
                                 "the checkpoint of another geometry",
                                 "continue with the scene it was written "
                                 "with"));
      }
    }


    void
    SceneAnalysis::make_physical_mesh(Geometry geometry)
    {
      Stage stage(progress, "geometry");
      physical_mesh = std::make_unique<PhysicalMesh>(Geometry(geometry));
      problem       = scene.make_problem();
      scene.add_water(*physical_mesh, problem);
      problem.check(*physical_mesh);
      check_problem();
      check_loads_on_cracks();
      const FractureParameters &fracture = scene.parameters().fracture;
      if (!fracture.intensity_factors)
        return;
      // The functions of a tip cover have no part for an initial stress that varies.
      if (fracture.tips == FractureParameters::Tips::automatic &&
          can_have_tip_covers() && !problem.has_varying_initial_stress() &&
          !scene.parameters().in_situ_stress.is_present)
        add_tip_covers(std::move(geometry));
      crack_tips = std::make_unique<CrackTips>(scene, *physical_mesh, problem);
    }


    void
    SceneAnalysis::check_loads_on_cracks() const
    {
      if (!scene.parameters().fracture.intensity_factors ||
          scene.parameters().model.kinematics != Kinematics::finite)
        return;
      // Intensity factors are computed as seen by an observer who turns with the material.
      for (const BoundaryCondition &condition : problem.boundary_conditions)
        for (const unsigned int curve : condition.curves_in(*physical_mesh))
          AssertThrow(
            physical_mesh->curves()[curve].role != CurveRole::joint ||
              condition.type == BoundaryCondition::Type::follower_pressure,
            InputError(
              "a load on the faces of a crack does not turn with them, "
              "but intensity factors of finite kinematics need one "
              "that does",
              "parameter 'Boundary conditions/" + condition.name + "/Type'",
              "set it to follower pressure"));
    }


    void
    SceneAnalysis::keep_geometry()
    {
      std::vector<Curve> &curves = geometry.curves();
      curves                     = physical_mesh->curves();
      curves.erase(std::remove_if(curves.begin(),
                                  curves.end(),
                                  [](const Curve &curve) {
                                    return curve.is_auxiliary;
                                  }),
                   curves.end());
    }


    void
    SceneAnalysis::clear()
    {
      evaluator.reset();
      recovery.reset();
      field.reset();
      crack_tips.reset();
      probes.reset();
      contact.reset();
      solid.reset();
      tip_covers.clear();
      physical_mesh.reset();
    }


    void
    SceneAnalysis::build(Geometry geometry)
    {
      clear();
      const SceneParameters &parameters = scene.parameters();
      make_physical_mesh(std::move(geometry));
      // The solid is made again only while cracks grow, and then no blocks are merged.
      const std::vector<CleaningAction> &merged =
        physical_mesh->merged_blocks();
      cleaning_actions.insert(cleaning_actions.end(),
                              merged.begin(),
                              merged.end());
      solid = make_solid();
      if (parameters.in_situ_stress.is_present)
        set_in_situ_stress(parameters.in_situ_stress,
                           solid->manifold_mesh(),
                           problem);
      probes = std::make_unique<ProbePoints>(solid->manifold_mesh(),
                                             parameters.probes);
      if (parameters.contact.is_present())
      {
        Stage stage(progress, "faces");
        contact = std::make_unique<ContactAnalysis>(scene, *solid, problem);
      }
      check_load_values(solid->covers(), solid->quadrature(), problem);
      make_system();
      add_counts();
      if (parameters.fracture.n_increments > 0)
        keep_geometry();
      if (series)
        series->follow(solid->covers(), contact.get());
    }


    void
    SceneAnalysis::add_tip_covers(Geometry geometry)
    {
      // A crack that grows is straight over its last increment only. Covers of that size would
      // cost more cells than they spare, in each increment.
      const FractureParameters &fracture = scene.parameters().fracture;
      tip_covers                         = make_tip_covers(*physical_mesh,
                                   problem,
                                   fracture.radius,
                                   fracture.n_increments > 0 ? 0.4 : 1e-6);
      if (tip_covers.empty())
        return;
      add_circles(tip_covers, *physical_mesh, geometry);
      physical_mesh = std::make_shared<const PhysicalMesh>(std::move(geometry));
    }


    std::unique_ptr<Solid>
    SceneAnalysis::make_solid()
    {
      const SceneParameters            &scene_parameters = scene.parameters();
      std::unique_ptr<MathematicalMesh> mesh;
      {
        Stage stage(progress, "mathematical mesh");
        mesh = std::make_unique<MathematicalMesh>(scene.make_mathematical_mesh(
          *physical_mesh, communicator, further_sizes));
      }
      SolidParameters parameters;
      parameters.stabilization      = scene_parameters.covers.stabilization;
      parameters.threshold          = scene_parameters.covers.threshold;
      parameters.own_meshes.regions = scene.make_region_meshes(*physical_mesh);
      parameters.own_meshes.memory_per_cell = scene.memory_per_cell();
      parameters.may_touch   = scene_parameters.contact.is_present();
      parameters.begin_stage = [this](const std::string &name) {
        return std::make_shared<Stage>(progress, name);
      };
      // The stiffness matrix needs the degree 2p - 2, and a constant body force p. A body force
      // or an initial stress that varies is integrated with the accuracy of the mass matrix. The energy of finite
      // strains needs 4p - 4: with less, the result depends on which points the rules of cut
      // elements have, and rounding may decide that.
      const unsigned int p         = mesh->degree();
      parameters.quadrature_degree = std::max(
        {scene_parameters.model.kinematics == Kinematics::finite ? 4 * p - 4
                                                                 : 2 * p - 2,
         p,
         problem.body_force || problem.has_forces_of_materials() ||
             problem.has_varying_initial_stress() ||
             scene_parameters.in_situ_stress.is_present
           ? 2 * p
           : 0});
      return std::make_unique<Solid>(physical_mesh,
                                     std::move(mesh),
                                     communicator,
                                     parameters);
    }


    void
    SceneAnalysis::add_counts()
    {
      const auto [first, last] = solid->covers().locally_owned_elements();
      double area = 0., smallest = 1.;
      for (unsigned int element = first; element < last; ++element)
      {
        const double fraction = solid->quadrature().area_fraction(element);
        smallest              = std::min(smallest, fraction);
        area += fraction * solid->mathematical_mesh().cell_area(
                             solid->manifold_mesh().cell(element));
      }
      namespace MPI = dealii::Utilities::MPI;
      summary.add("ranks", MPI::n_mpi_processes(communicator));
      summary.add("degree", solid->mathematical_mesh().degree());
      summary.add("blocks", physical_mesh->n_blocks());
      summary.add("regions", physical_mesh->regions().size());
      const std::vector<Curve> &curves = physical_mesh->curves();
      summary.add("joints",
                  std::count_if(curves.begin(),
                                curves.end(),
                                [](const Curve &curve) {
                                  return curve.role == CurveRole::joint;
                                }));
      add_block_counts();
      summary.add("own_meshes", solid->mathematical_mesh().n_parts() - 1);
      summary.add("cells", solid->mathematical_mesh().n_cells());
      summary.add("cells_cut_exactly",
                  solid->manifold_mesh().n_cells_cut_exactly());
      summary.add("mathematical_covers",
                  solid->mathematical_mesh().n_mathematical_covers());
      summary.add("manifold_elements", solid->manifold_mesh().n_elements());
      summary.add("physical_covers", solid->covers().n_covers());
      summary.add("aggregated_covers",
                  solid->aggregation().cover_to_root.size());
      double n_unknowns = 2. * (solid->covers().n_covers() -
                                solid->aggregation().cover_to_root.size());
      for (const auto &cover : tip_covers)
        n_unknowns += cover->n_functions();
      summary.add("unknowns", n_unknowns);
      summary.add("area",
                  MPI::sum(area, communicator),
                  scene.parameters().output.length_unit + "^2");
      summary.add("smallest_area_fraction", MPI::min(smallest, communicator));
      summary.add("quadrature_fallbacks",
                  MPI::sum(solid->quadrature().n_fallbacks(), communicator));
      summary.add("cleaning_actions", cleaning_actions.size());
      summary.add("notices",
                  scene.notices().size() + scene_notices.size() +
                    physical_mesh->notices().size() + solid->notices().size() +
                    (crack_tips ? crack_tips->notices().size() : 0));
    }


    void
    SceneAnalysis::add_block_counts()
    {
      const std::string  &length = scene.parameters().output.length_unit;
      std::vector<double> areas(physical_mesh->n_blocks(), 0.);
      for (const PhysicalMesh::Region &region : physical_mesh->regions())
        areas[region.block] += region.area;
      const double limit = scene.parameters().geometry.small_block;
      summary.add("smallest_block_area",
                  *std::min_element(areas.begin(), areas.end()),
                  length + "^2");
      summary.add("small_blocks",
                  std::count_if(areas.begin(),
                                areas.end(),
                                [&](const double area) {
                                  return limit > 0. && area < limit;
                                }));
      double merged_area = 0.;
      for (const CleaningAction &action : physical_mesh->merged_blocks())
        merged_area += action.area;
      summary.add("merged_blocks", physical_mesh->merged_blocks().size());
      summary.add("merged_area", merged_area, length + "^2");
      const PhysicalMesh::DanglingEnds &ends = physical_mesh->dangling_ends();
      summary.add("crack_tips", find_crack_ends(*physical_mesh).size());
      summary.add("tip_covers", tip_covers.size());
      summary.add("crack_length", ends.length_kept, length);
      summary.add("dropped_ends", ends.n_dropped);
      summary.add("dropped_length", ends.length_dropped, length);
    }


    std::pair<dealii::Point<2>, double>
    SceneAnalysis::tip_in_the_largest_cell() const
    {
      std::pair<dealii::Point<2>, double> largest;
      for (const CrackEnd &end : find_crack_ends(*physical_mesh))
      {
        const dealii::Point<2> &tip = end.point;
        if (std::any_of(tip_covers.begin(),
                        tip_covers.end(),
                        [&](const auto &cover) {
                          return cover->tip().point == tip;
                        }))
          continue;
        const unsigned int element = solid->manifold_mesh().find_element(tip);
        if (element == invalid_index)
          continue;
        const double size = solid->mathematical_mesh().cell_diameter(
          solid->manifold_mesh().cell(element));
        if (size > largest.second)
          largest = {tip, size};
      }
      return largest;
    }


    std::vector<std::string>
    SceneAnalysis::block_notices() const
    {
      const std::string       &length = scene.parameters().output.length_unit;
      std::vector<std::string> result;
      const PhysicalMesh::DanglingEnds &ends = physical_mesh->dangling_ends();
      std::ostringstream                text;
      if (ends.length_dropped > 0.)
      {
        text << "joints that bound no block were dropped over "
             << ends.length_dropped << ' ' << length << ", " << ends.n_dropped
             << " end(s)";
        result.push_back(text.str());
      }
      if (ends.length_kept > 0. && !scene.parameters().joint_sets.empty())
      {
        text.str("");
        text << "joints that bound no block are cracks over "
             << ends.length_kept << ' ' << length << ", with " << ends.n_kept
             << " tip(s)";
        result.push_back(text.str());
      }
      const auto [tip, cell_size] = tip_in_the_largest_cell();
      double mean_length          = 0.;
      for (const CrackEnd &end : find_crack_ends(*physical_mesh))
        mean_length += end.length / summary.value("crack_tips");
      // Where the mesh is graded, CrackTips names the tips at which it is not.
      if (cell_size > 1e-3 * mean_length &&
          !(crack_tips && scene.parameters().fracture.grades_mesh()))
      {
        text.str("");
        text
          << "a crack opens up to the cell only that holds its tip: the cell "
             "of the tip at "
          << to_string(tip) << " is of " << cell_size << ' ' << length
          << ", cracks have a mean length of " << mean_length << ' ' << length
          << "; 'Fracture/Tips = graded' makes cells at tips small";
        result.push_back(text.str());
      }
      // Where small blocks are merged, PhysicalMesh names those that remain.
      if (summary.value("small_blocks") > 0. &&
          !scene.parameters().geometry.merges_small_blocks)
      {
        text.str("");
        text << summary.value("small_blocks") << " of "
             << summary.value("blocks") << " blocks are smaller than "
             << scene.parameters().geometry.small_block << ' ' << length
             << "^2, the smallest " << summary.value("smallest_block_area")
             << ' ' << length
             << "^2: 'Geometry/Small blocks = merge' makes them parts of their "
                "neighbours, and 'Geometry/Cleaning tolerance' moves ends of "
                "joints that nearly meet";
        result.push_back(text.str());
      }
      return result;
    }


    SceneAnalysis::FormerSolid
    SceneAnalysis::release_solid()
    {
      return {std::move(solid), std::move(contact)};
    }


    void
    SceneAnalysis::print_report()
    {
      if (!cleaning_actions.empty())
        progress.message("  cleaned: " + summarize(cleaning_actions));
      std::vector<std::string> notices = scene.notices();
      const auto add_notices = [&](const std::vector<std::string> &n) {
        notices.insert(notices.end(), n.begin(), n.end());
      };
      add_notices(scene_notices);
      add_notices(physical_mesh->notices());
      add_notices(block_notices());
      if (crack_tips)
        add_notices(crack_tips->notices());
      add_notices(solid->notices());
      if (contact)
        add_notices(contact->notices());
      for (const std::string &notice : merge_alike(notices))
        progress.message("  notice: " + notice);

      const auto count = [&](const std::string &name) {
        std::ostringstream text;
        text << std::fixed;
        text.precision(0);
        text << summary.value(name);
        return text.str();
      };
      progress.message("  " + count("blocks") + " block(s), " +
                       count("regions") + " region(s), " + count("joints") +
                       " joint(s), " + count("cells") + " cells (" +
                       count("cells_cut_exactly") + " cut exactly), " +
                       count("mathematical_covers") + " mathematical covers");
      progress.message("  " + count("manifold_elements") +
                       " manifold elements, " + count("physical_covers") +
                       " physical covers (" + count("aggregated_covers") +
                       " aggregated), " + count("unknowns") + " unknowns");
      std::ostringstream smallest;
      smallest << "  smallest element area over cell area "
               << summary.value("smallest_area_fraction");
      progress.message(smallest.str());
      if (contact)
        progress.message("  contact: " + contact->description());
      if (summary.value("quadrature_fallbacks") > 0.)
        progress.message("  warning: " + count("quadrature_fallbacks") +
                         " quadrature rule(s) of lower quality");
    }


    void
    SceneAnalysis::compute_intensity_factors()
    {
      if (!crack_tips)
        return;
      Stage      stage(progress, "intensity factors");
      TipLoading loading;
      if (contact)
        loading.contact_forces = contact->forces_on_faces();
      crack_tips->compute(*field, problem_now(), loading);
    }


    void
    SceneAnalysis::report_initial_balance(
      const dealii::TrilinosWrappers::MPI::Vector &forces)
    {
      if (!problem.has_varying_initial_stress() || forces.size() == 0)
        return;
      namespace MPI            = dealii::Utilities::MPI;
      double           largest = 0.;
      auto             here    = solid->covers().locally_owned_dofs(2).begin();
      dealii::Point<2> place;
      for (unsigned int i = 0; i < forces.locally_owned_size();
           i += 2, ++ ++here)
      {
        const double size =
          std::hypot(forces(*here), forces(unknown_of(cover_of(*here), 1)));
        if (size > largest)
        {
          largest = size;
          place   = solid->covers().node(cover_of(*here));
        }
      }
      const auto all = MPI::min_max_avg(largest, communicator);
      if (MPI::this_mpi_process(communicator) != all.max_index)
        place = dealii::Point<2>();
      for (unsigned int d = 0; d < 2; ++d)
        place[d] = MPI::sum(place[d], communicator);
      const auto region_to_material =
        problem.region_to_material(*physical_mesh);
      double weight = 0.;
      for (unsigned int r = 0; r < region_to_material.size(); ++r)
        weight += problem.gravity.norm() * physical_mesh->regions()[r].area *
                  problem.materials[region_to_material[r]].density;
      std::ostringstream text;
      text.precision(3);
      text << "  the largest force out of balance with the initial stress is "
           << all.max << " per unit thickness, at " << to_string(place);
      if (weight > 0.)
        text << ", " << all.max / weight << " of the weight";
      progress.message(text.str());
      summary.add("initial_imbalance",
                  weight > 0. ? all.max / weight : all.max);
    }


    bool
    SceneAnalysis::is_first_rank() const
    {
      return dealii::Utilities::MPI::this_mpi_process(communicator) == 0;
    }


    double
    SceneAnalysis::small_strain_energy() const
    {
      double energy            = 0.;
      const auto [first, last] = solid->covers().locally_owned_elements();
      for (unsigned int element = first; element < last; ++element)
      {
        if (is_removed(element))
          continue;
        const dealii::Quadrature<2> &rule = solid->quadrature().rule(element);
        const double determinant = 2. * solid->mathematical_mesh().cell_area(
                                          solid->manifold_mesh().cell(element));
        for (unsigned int q = 0; q < rule.size(); ++q)
        {
          const auto gradient =
            field->gradient_of_covers(element, rule.point(q));
          const auto elastic_stress =
            field->stress_from_gradient(element, rule.point(q), gradient) -
            field->stress_from_gradient(element,
                                        rule.point(q),
                                        dealii::Tensor<2, 2>());
          energy += 0.5 * determinant * rule.weight(q) *
                    (elastic_stress * dealii::symmetrize(gradient));
        }
      }
      return problem.thickness *
             dealii::Utilities::MPI::sum(energy, communicator);
    }


    void
    SceneAnalysis::on_first_rank(const std::function<void()> &action) const
    {
      NMM::on_first_rank(communicator, action);
    }


    std::unique_ptr<CrackSample>
    SceneAnalysis::sample_cracks() const
    {
      if (!evaluator || !crack_tips ||
          crack_tips->all_factors().size() != crack_tips->all_tips().size())
        return nullptr;
      std::vector<Probe> tips;
      for (const CrackTip &tip : crack_tips->all_tips())
      {
        tips.emplace_back();
        tips.back().name  = "crack tip";
        tips.back().point = tip.point;
      }
      auto              cracks = std::make_unique<CrackSample>();
      const ProbePoints points(solid->manifold_mesh(), tips);
      const auto [first, last] = solid->covers().locally_owned_elements();
      for (unsigned int i = 0; i < tips.size(); ++i)
      {
        const ProbePoints::Entry &entry = points.entries()[i];
        dealii::Tensor<1, 2>      u;
        if (entry.element >= first && entry.element < last)
          u = evaluator->displacement(entry.element, entry.x);
        u = dealii::Utilities::MPI::sum(u, communicator);
        if (crack_tips->has_factors(i))
          cracks->tips.push_back({entry.x,
                                  u,
                                  crack_tips->all_tips()[i].direction,
                                  crack_tips->all_factors()[i]});
      }
      if (growth_table != nullptr)
        for (const Increment &increment : growth_table->increments())
          cracks->increments.emplace_back(increment.advance.tip, increment.end);
      return cracks;
    }


    void
    SceneAnalysis::open(const OutputDirectory &output_directory)
    {
      directory = &output_directory;
      series    = std::make_unique<StateSeries>(scene,
                                             solid->covers(),
                                             contact.get(),
                                             *directory);
      open_files();
    }


    void
    SceneAnalysis::open_files()
    {
      on_first_rank([&]() { directory->create(); });
    }


    void
    SceneAnalysis::write_cleaning() const
    {
      if (!cleaning_actions.empty() && is_first_rank())
        directory->write_text("cleaning.csv", [&](std::ostream &out) {
          write_table(cleaning_actions, out);
        });
    }


    bool
    SceneAnalysis::continues_in_folder() const
    {
      const bool has_history =
        !restart.empty() && is_first_rank() &&
        std::filesystem::exists(directory->path() / "history.csv");
      return dealii::Utilities::MPI::logical_or(has_history, communicator);
    }


    std::string
    SceneAnalysis::checkpoint_file() const
    {
      return directory->file("checkpoint.nmm");
    }


    void
    SceneAnalysis::write()
    {
      const OutputParameters &parameters = scene.parameters().output;
      const bool              was_solved = is_solved;
      std::string             fault;
      {
        Stage stage(progress, "output");
        write_cleaning();
        if (evaluator && !probes->entries().empty())
        {
          const auto samples = probes->evaluate(solid->covers(), *evaluator);
          for (unsigned int i = 0; i < samples.size() && fault.empty(); ++i)
            if (samples[i])
              fault = find_not_finite(*samples[i], probes->entries()[i].x);
          if (is_first_rank())
            directory->write_text("probes.csv", [&](std::ostream &out) {
              probes->write(out, samples);
            });
        }

        if (crack_tips && is_first_rank())
          crack_tips->write(*directory);

        const auto           cracks = sample_cracks();
        const FieldTriangles triangles(solid->covers(), evaluator.get());
        if (fault.empty())
          fault = triangles.find_not_finite(communicator);
        if (fault.empty())
          fault = summary.find_not_finite();
        is_solved = is_solved && fault.empty();
        summary.add("max_displacement",
                    triangles.max_displacement(communicator),
                    parameters.length_unit);
        if (parameters.fields)
          series->finish(last_value(),
                         write_fields_of_state(
                           solid->covers(), triangles, *directory, "fields"),
                         cracks.get());
        if (evaluator)
          series->finish_contact(last_value());
        // A motion is at some time; load steps and lengths of cracks end with the scene.
        std::ostringstream when;
        if (is_solved &&
            (scene.parameters().model.analysis == Analysis::dynamics ||
             scene.parameters().model.analysis == Analysis::relaxation))
          when << ", t = " << last_value() << " s";
        PictureData drawn;
        if (parameters.picture)
          drawn =
            series->draw(cracks.get(),
                         triangles,
                         evaluator.get(),
                         scene.title() + when.str() +
                           (is_solved ? "" : " (" + unsolved_note() + ")"),
                         "picture.png");
        on_first_rank([&]() {
          series->write_animation(last_value(), evaluator ? &drawn : nullptr);
        });
      }
      write_summary();
      AssertThrow(
        fault.empty() || !was_solved,
        NumericalFailure(fault,
                         "the last state",
                         "take shorter steps, or look for loads, stiffness "
                         "and velocities of extreme size"));
    }


    void
    SceneAnalysis::write_summary()
    {
      summary.add("solved", is_solved ? 1. : 0.);
      double total = 0.;
      for (const auto &[name, seconds] : progress.times())
      {
        std::string row = "time_" + name;
        std::replace(row.begin(), row.end(), ' ', '_');
        summary.add(row, seconds, "s");
        total += seconds;
      }
      summary.add("time_total", total, "s");
      summary.add("peak_memory", peak_memory(communicator), "MB");
      if (is_first_rank())
        directory->write_text("summary.csv",
                              [&](std::ostream &out) { summary.write(out); });
    }
  } // namespace internal
} // namespace NMM
