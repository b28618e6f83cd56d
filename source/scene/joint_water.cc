#include <nmm/base/exceptions.h>
#include <nmm/output/csv_series.h>

#include <algorithm>
#include <scene/bolts.h>
#include <scene/joint_water.h>
#include <scene/parsing.h>
#include <sstream>

namespace NMM
{
  namespace internal
  {
    namespace
    {
      bool
      has_flow(const Scene &scene)
      {
        return scene.parameters().water.joint_pressure ==
               WaterParameters::JointPressure::network;
      }
    } // namespace


    std::unique_ptr<SceneJointWater>
    SceneJointWater::make(const Scene &scene)
    {
      return has_flow(scene) ? std::make_unique<SceneJointWater>(scene)
                             : nullptr;
    }


    SceneJointWater::SceneJointWater(const Scene &scene)
      : scene(&scene)
    {
    }


    TermMaker
    SceneJointWater::maker(const bool is_at_rest)
    {
      return [this, is_at_rest](const Solid &solid, const ModelLayout &layout) {
        auto result = std::make_unique<JointWaterTerm>(
          solid, layout, scene->parameters().water.make_flow(is_at_rest));
        term = result.get();
        return result;
      };
    }


    double
    SceneJointWater::largest_pressure() const
    {
      double result = 0.;
      for (unsigned int k = 0; k < term->flow().heads.size(); ++k)
        result = std::max(result, term->pressure(k));
      return result;
    }


    void
    SceneJointWater::repeat_until_flow_agrees(
      Equilibrium                                            &equilibrium,
      const std::function<void(const ContactStep &,
                               const Equilibrium::Vector &)> &after_step) const
    {
      constexpr unsigned int max_repetitions = 100;
      constexpr double       tolerance       = 1e-6;
      LoadSteps              again;
      again.leaves_out_reached = false;
      again.load_factors       = {equilibrium.load_factor()};
      for (unsigned int i = 0; term->change() > tolerance * largest_pressure();
           ++i)
      {
        AssertThrow(i < max_repetitions,
                    NumericalFailure(
                      "The flow in joints and their apertures do not agree "
                      "after " +
                        std::to_string(i) + " repetitions: " + progress(),
                      "load factor " + to_text(equilibrium.load_factor()),
                      "choose a higher 'Contact/Normal stiffness', or a higher "
                      "'Water/Residual aperture'"));
        equilibrium.run(again, after_step);
      }
    }


    std::string
    SceneJointWater::progress() const
    {
      std::ostringstream text;
      text.precision(3);
      text << "water in joints has changed by " << term->change() << ' '
           << scene->parameters().output.stress_unit;
      return text.str();
    }


    void
    SceneJointWater::write(const OutputDirectory &directory) const
    {
      if (term->flow().flows.empty())
        return;
      const FlowNetwork &network = term->network();
      const NetworkFlow &flow    = term->flow();
      directory.write_text("joint-flow.csv", [&](std::ostream &out) {
        out << "joint,x_1,y_1,x_2,y_2,head_1,head_2,pressure_1,pressure_2,"
               "aperture_1,aperture_2,flow\n";
        out.precision(12);
        for (unsigned int l = 0; l < network.links.size(); ++l)
        {
          const FlowNetwork::Link &link = network.links[l];
          out << quoted(term->joints()[l]);
          for (const unsigned int node : link.nodes)
            out << ',' << term->positions()[node][0] << ','
                << term->positions()[node][1];
          for (const unsigned int node : link.nodes)
            out << ',' << flow.heads[node];
          for (const unsigned int node : link.nodes)
            out << ',' << term->pressure(node);
          for (const double aperture : link.apertures)
            out << ',' << aperture;
          out << ',' << flow.flows[l] << '\n';
        }
      });
    }


    void
    SceneJointWater::add_to(Summary &summary) const
    {
      const OutputParameters &output = scene->parameters().output;
      double                  inflow = 0., least = 0., largest = 0.;
      for (const double q : term->flow().inflows)
        inflow += std::max(0., q);
      for (const FlowNetwork::Link &link : term->network().links)
        for (const double b : link.apertures)
        {
          least   = least == 0. ? b : std::min(least, b);
          largest = std::max(largest, b);
        }
      summary.add("joint_flow_links", term->network().links.size());
      summary.add("joint_inflow", inflow, output.length_unit + "^2/s");
      summary.add("largest_joint_pressure",
                  largest_pressure(),
                  output.stress_unit);
      summary.add("least_aperture", least, output.length_unit);
      summary.add("largest_aperture", largest, output.length_unit);
      summary.add("dry_joint_nodes", term->flow().n_dry);
    }


    std::vector<TermMaker>
    further_terms(const Scene &scene)
    {
      std::vector<TermMaker> result =
        SceneBolts::makers(scene, SceneBolts::Installed::before);
      if (has_flow(scene))
        result.push_back(
          [&scene](const Solid &solid, const ModelLayout &layout) {
            return std::make_unique<JointWaterTerm>(
              solid,
              layout,
              scene.parameters().water.make_flow(/* is_at_rest = */ false));
          });
      return result;
    }
  } // namespace internal
} // namespace NMM
