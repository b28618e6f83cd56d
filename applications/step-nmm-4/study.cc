#include "study.h"

#include <nmm/base/exceptions.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/parameter_handler.h>
#include <deal.II/base/patterns.h>
#include <deal.II/base/utilities.h>

#include "tutorial/tutorial.h"
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iomanip>
#include <iostream>
#include <map>
#include <numeric>
#include <sstream>

namespace StepNMM4
{
  using namespace dealii;

  // @sect3{Parameters}

  namespace
  {
    bool
    is_first_rank()
    {
      return Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0;
    }
  } // namespace


  Parameters
  read_parameters(const std::string &file_name,
                  const std::string &output_directory)
  {
    Parameters parameters;
    parameters.output_directory = output_directory;

    ParameterHandler       prm;
    const Patterns::Double positive(1e-300);
    prm.add_parameter("Friction angles",
                      parameters.friction_angles,
                      "One run for each [degrees].",
                      Patterns::List(Patterns::Double(0., 89.), 1));
    prm.add_parameter("Time step",
                      parameters.step,
                      "The longest [s].",
                      positive);
    prm.add_parameter("Half step",
                      parameters.is_halved,
                      "Compute what falls with half of the step, too.");
    prm.add_parameter("Perturbation",
                      parameters.perturbation,
                      "Of the friction angle, in one more run of what falls; "
                      "0: none [degrees].",
                      Patterns::Double(0.));
    prm.add_parameter("Perturbed runs",
                      parameters.n_perturbed,
                      "With 1, 2, ... times the perturbation; more than one: "
                      "also with half of the step, if that is asked for.",
                      Patterns::Integer(0, 1000));
    prm.add_parameter("End time",
                      parameters.end_time,
                      "Or at rest [s].",
                      positive);
    prm.add_parameter("Stages",
                      parameters.stages,
                      "Times of pictures besides begin and end [s].",
                      Patterns::List(Patterns::Double(0.), 0));
    prm.add_parameter("Block length",
                      parameters.block_length,
                      "Along the layers [m].",
                      Patterns::Double(0.5, 10.));
    prm.add_parameter("Layer",
                      parameters.layer,
                      "Thickness of layers [m].",
                      Patterns::Double(0.5, 5.));
    prm.add_parameter("Spring",
                      parameters.spring,
                      "Of faces, normal and along them [Pa/m].",
                      positive);
    prm.add_parameter("Dashpot",
                      parameters.dashpot,
                      "The same [Pa s/m].",
                      Patterns::Double(0.));
    prm.add_parameter("Rock damping",
                      parameters.damping,
                      "Of blocks, times their stiffness [s].",
                      Patterns::Double(0.));
    Tutorial::read_parameter_file(prm, file_name, "step-nmm-4.prm");
    std::sort(parameters.stages.begin(), parameters.stages.end());
    return parameters;
  }


  // @sect3{Outcomes}

  void
  Outcome::finish()
  {
    released = rows.back().external_work;
    std::vector<double> penetrations, overlaps;
    for (const Row &row : rows)
    {
      account_error = std::max(account_error, std::abs(row.balance));
      penetrations.push_back(row.penetration_over_block);
      overlaps.push_back(row.overlap_over_block);
    }
    if (released != 0.)
      account_error /= std::abs(released);
    penetration_at_rest = penetrations.back();
    overlap_at_rest     = overlaps.back();
    std::sort(penetrations.begin(), penetrations.end());
    std::sort(overlaps.begin(), overlaps.end());
    largest_penetration = penetrations.back();
    largest_overlap     = overlaps.back();
    median_penetration  = penetrations[penetrations.size() / 2];
    median_overlap      = overlaps[overlaps.size() / 2];
  }


  bool
  Outcome::stands() const
  {
    constexpr double settlement = 0.05;
    return is_at_rest && rows.back().center_of_mass.distance(
                           rows.front().center_of_mass) < settlement;
  }


  // @sect3{Tables}

  void
  print_header(const Outcome &outcome)
  {
    std::cout
      << std::setprecision(9) << "\nFriction angle " << outcome.friction_angle
      << " degrees, steps of " << outcome.step << " s: " << outcome.n_blocks
      << " blocks, " << outcome.n_unknowns << " unknowns\n"
      << " time   centre of mass       kinetic   released  dissipated   "
         "balance  stick  slip  penetration\n"
      << "    s                m          kJ/m       kJ/m        kJ/m "
         "     kJ/m                    block"
      << std::endl;
  }


  void
  print(const Row &row)
  {
    std::cout << std::fixed << std::setprecision(2) << std::setw(5) << row.time
              << std::setprecision(4) << std::setw(9) << row.center_of_mass[0]
              << std::setw(9) << row.center_of_mass[1] << std::setprecision(2)
              << std::setw(14) << 1e-3 * row.kinetic << std::setw(11)
              << 1e-3 * row.external_work << std::setw(12)
              << 1e-3 * row.dissipated << std::scientific
              << std::setprecision(1) << std::setw(10) << 1e-3 * row.balance
              << std::defaultfloat << std::setw(7) << row.n_stick
              << std::setw(6) << row.n_slip << std::scientific
              << std::setprecision(1) << std::setw(13)
              << row.penetration_over_block << std::defaultfloat << std::endl;
  }


  namespace
  {
    /// Between rows, or where the run ended.
    Point<2>
    center_of_mass_at(const Outcome &outcome, const double time)
    {
      const auto after = std::lower_bound(outcome.rows.begin(),
                                          outcome.rows.end(),
                                          time,
                                          [](const Row &row, const double t) {
                                            return row.time < t;
                                          });
      if (after == outcome.rows.begin() || after == outcome.rows.end())
        return (after == outcome.rows.end() ? outcome.rows.back() : *after)
          .center_of_mass;
      const Row &row = *(after - 1);
      return row.center_of_mass +
             (time - row.time) / (after->time - row.time) *
               (after->center_of_mass - row.center_of_mass);
    }


    /// Of the centres of mass at times that the rows on the screen have.
    void
    print_difference(const Outcome &first, const Outcome &other)
    {
      std::cout << "\ncentre of mass of the run '" << other.name
                << "' against '" << first.name
                << "'\n time   difference    of its way\n";
      const Point<2> start = first.rows.front().center_of_mass;
      double         next  = 0.5;
      for (const Row &at : first.rows)
      {
        if (at.time < next && &at != &first.rows.back())
          continue;
        next                      = std::floor(2. * at.time) / 2. + 0.5;
        const Point<2> position   = center_of_mass_at(other, at.time);
        const double   difference = position.distance(at.center_of_mass);
        std::cout << std::fixed << std::setprecision(2) << std::setw(5)
                  << at.time << std::setprecision(4) << std::setw(11)
                  << difference << " m" << std::setprecision(3) << std::setw(10)
                  << 100. * difference / at.center_of_mass.distance(start)
                  << " %\n"
                  << std::defaultfloat;
      }
      const double at_end = other.rows.back().center_of_mass.distance(
        first.rows.back().center_of_mass);
      std::cout << " ends" << std::fixed << std::setprecision(4)
                << std::setw(11) << at_end << " m" << std::setprecision(3)
                << std::setw(10)
                << 100. * at_end /
                     first.rows.back().center_of_mass.distance(start)
                << " %" << std::defaultfloat << std::endl;
    }
  } // namespace


  void
  print_summary(const std::vector<Outcome> &outcomes)
  {
    std::cout
      << "\nrun                        outcome        time [s]  steps  cuts  "
         "iterations  account   penetration: largest, last   overlap: largest, "
         "last  s\n";
    for (const Outcome &outcome : outcomes)
      std::cout << std::left << std::setw(27) << outcome.name << std::setw(15)
                << (outcome.stands()     ? "stands"
                    : outcome.is_at_rest ? "slid to rest"
                                         : "moves at end")
                << std::right << std::fixed << std::setprecision(2)
                << std::setw(8) << outcome.rows.back().time << std::setw(7)
                << outcome.n_steps << std::setw(6) << outcome.n_cuts
                << std::setw(12) << outcome.n_iterations << std::scientific
                << std::setprecision(1) << std::setw(9) << outcome.account_error
                << std::setw(14) << outcome.largest_penetration << std::setw(13)
                << outcome.penetration_at_rest << std::setw(18)
                << outcome.largest_overlap << std::setw(9)
                << outcome.overlap_at_rest << std::fixed << std::setw(8)
                << outcome.start_time + outcome.motion_time << std::defaultfloat
                << '\n';
    for (const Outcome &other : outcomes)
      for (const Outcome &first : outcomes)
        if (&other != &first && other.name.rfind(first.name + '-', 0) == 0)
          print_difference(first, other);
  }


  void
  print_means(const std::vector<Outcome> &outcomes)
  {
    // those of a friction angle as it is in names and a step
    std::map<std::pair<std::string, double>, std::vector<const Outcome *>> runs;
    for (const Outcome &outcome : outcomes)
      runs[{outcome.name.substr(0, outcome.name.find('-')), outcome.step}]
        .push_back(&outcome);
    for (const auto &[run, members] : runs)
    {
      const double n = members.size();
      if (n < 3.)
        continue;
      double end = 0.;
      for (const Outcome *outcome : members)
        end = std::max(end, outcome->rows.back().time);
      std::cout << "\nway of the centre of mass, friction angle " << run.first
                << " degrees, steps of " << run.second << " s, "
                << members.size()
                << " runs\n time   mean [m]  its error  deviation   least  "
                   "largest\n";
      for (double time = std::min(1., end);; time = std::min(time + 1., end))
      {
        std::vector<double> ways;
        for (const Outcome *outcome : members)
          ways.push_back(center_of_mass_at(*outcome, time)
                           .distance(outcome->rows.front().center_of_mass));
        const double mean = std::accumulate(ways.begin(), ways.end(), 0.) / n;
        double       squares = 0.;
        for (const double way : ways)
          squares += (way - mean) * (way - mean);
        const double deviation = std::sqrt(squares / (n - 1.));
        const auto [least, largest] =
          std::minmax_element(ways.begin(), ways.end());
        std::cout << std::fixed << std::setprecision(2) << std::setw(5) << time
                  << std::setprecision(4) << std::setw(11) << mean
                  << std::setw(11) << deviation / std::sqrt(n) << std::setw(11)
                  << deviation << std::setw(9) << *least << std::setw(9)
                  << *largest << std::defaultfloat << std::endl;
        if (time == end)
          break;
      }
    }
  }


  void
  write_results(const Parameters           &parameters,
                const std::vector<Outcome> &outcomes)
  {
    const std::string prefix = parameters.output_directory + "/step-nmm-4-";
    std::ofstream     runs(prefix + "runs.csv");
    runs << "run,friction_angle,step,blocks,unknowns,steps,cuts,iterations,"
            "is_at_rest,stands,end_time,released,account_error,"
            "largest_penetration,median_penetration,penetration_at_rest,"
            "largest_overlap,median_overlap,overlap_at_rest,start_seconds,"
            "motion_seconds,way\n"
         << std::setprecision(10);
    for (const Outcome &o : outcomes)
    {
      runs << o.name << ',' << o.friction_angle << ',' << o.step << ','
           << o.n_blocks << ',' << o.n_unknowns << ',' << o.n_steps << ','
           << o.n_cuts << ',' << o.n_iterations << ',' << o.is_at_rest << ','
           << o.stands() << ',' << o.rows.back().time << ',' << o.released
           << ',' << o.account_error << ',' << o.largest_penetration << ','
           << o.median_penetration << ',' << o.penetration_at_rest << ','
           << o.largest_overlap << ',' << o.median_overlap << ','
           << o.overlap_at_rest << ',' << o.start_time << ',' << o.motion_time
           << ','
           << o.rows.back().center_of_mass.distance(
                o.rows.front().center_of_mass)
           << '\n';
      std::ofstream table(prefix + o.name + ".csv");
      table << "time,x,y,kinetic,strain,contact,dissipated,external_work,"
               "balance,stick,slip,penetration,penetration_over_block,overlap,"
               "overlap_over_block\n"
            << std::setprecision(10);
      for (const Row &r : o.rows)
        table << r.time << ',' << r.center_of_mass[0] << ','
              << r.center_of_mass[1] << ',' << r.kinetic << ',' << r.strain
              << ',' << r.contact << ',' << r.dissipated << ','
              << r.external_work << ',' << r.balance << ',' << r.n_stick << ','
              << r.n_slip << ',' << r.penetration << ','
              << r.penetration_over_block << ',' << r.overlap << ','
              << r.overlap_over_block << '\n';
    }
    AssertThrow(runs.flush().good(),
                NMM::InputError("results cannot be written",
                                prefix + "runs.csv",
                                "name a folder that can be written to"));
    std::cout << "Results: " << prefix << "*.csv, *.png, *-animation.html"
              << std::endl;
  }


  // @sect3{Pictures}

  // All in the same part of the plane.
  Film::Film(const Parameters &parameters_in, const Outcome &outcome)
    : prefix(parameters_in.output_directory + "/step-nmm-4-" + outcome.name)
  {
    std::ostringstream text;
    text << "Slope, friction angle " << outcome.friction_angle << " degrees";
    title                        = text.str();
    parameters.quantity          = NMM::Quantity::displacement;
    parameters.deformation_scale = 1.;
    parameters.mesh_lines        = false;
    parameters.picture_width     = 1200;
    if (is_first_rank())
    {
      // an earlier run's frames
      std::filesystem::remove(prefix + "-animation.frames");
      animation =
        std::make_unique<NMM::Animation>(prefix + "-animation.frames");
    }
  }


  const NMM::PictureParameters &
  Film::output() const
  {
    return parameters;
  }


  void
  Film::add_frame(const double time, const NMM::PictureData &data)
  {
    if (animation)
      animation->add_frame(time, data);
  }


  void
  Film::draw_stage(const double time, const NMM::PictureData &data)
  {
    if (!animation)
      return;
    std::ostringstream note;
    note << title << ", t = " << std::fixed << std::setprecision(2) << time
         << " s";
    NMM::PictureFrame frame;
    frame.view = std::make_pair(Point<2>(-33., -1.), Point<2>(21.5, 20.5));
    NMM::draw_picture(data,
                      parameters,
                      note.str(),
                      prefix + "-stage-" + std::to_string(++n_stages) + ".png",
                      frame);
  }


  void
  Film::finish()
  {
    if (!animation)
      return;
    std::ofstream out(prefix + "-animation.html");
    animation->write(out, title, parameters);
    animation->discard();
  }
} // namespace StepNMM4
