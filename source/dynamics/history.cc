#include <nmm/base/program.h>
#include <nmm/dynamics/history.h>

#include <deal.II/base/mpi.h>

#include <cstdio>
#include <iomanip>
#include <sstream>
#include <vector>

namespace NMM
{
  namespace
  {
    const char *const units =
      "# per unit thickness: energies [J/m], linear momentum [kg/s], angular "
      "momentum about the origin [kg m/s]; time and size [s], displacement and "
      "error [m]";
    const char *const common_names =
      "time,step,size,iterations,lost_iterations,max_displacement,error,"
      "kinetic,"
      "strain,conditions,dissipated,external_work,balance,momentum_x,momentum_"
      "y,"
      "angular_momentum";
  } // namespace


  History::History(const std::string              &filename,
                   const MPI_Comm                  communicator,
                   const int                       continue_after,
                   const std::vector<std::string> &further_columns)
    : filename(filename)
    , n_further(further_columns.size())
    , writes(dealii::Utilities::MPI::this_mpi_process(communicator) == 0)
  {
    if (!writes)
      return;
    std::string names = common_names;
    for (const std::string &column : further_columns)
      names += "," + column;
    std::string kept = std::string(units) + "\n" + names + "\n";
    if (continue_after >= 0)
    {
      std::ifstream in(filename);
      std::string   line;
      AssertThrow(std::getline(in, line) && std::getline(in, line) &&
                    line == names,
                  InputError("This is no history to continue",
                             filename,
                             "check its name, or start a new one"));
      while (std::getline(in, line))
      {
        // time,step,...
        std::istringstream row(line);
        double             time;
        char               comma;
        int                step;
        if ((row >> time >> comma >> step >> comma) && step <= continue_after)
          kept += line + "\n";
      }
    }
    // a kill must not lose the rows kept
    const std::string temporary = filename + ".part";
    {
      std::ofstream file(temporary, std::ios::trunc);
      file << kept << std::flush;
      if (file && std::rename(temporary.c_str(), filename.c_str()) == 0)
        out.open(filename, std::ios::app);
    }
    AssertThrow(out.is_open() && out, OutputFailure(filename));
  }


  void
  History::write(const TimeIntegrator      &integrator,
                 const StepRecord          &record,
                 const std::vector<double> &further_values)
  {
    if (!writes)
      return;
    AssertDimension(further_values.size(), n_further);
    const Account      &a     = integrator.account();
    const DynamicState &state = integrator.state();
    out << std::setprecision(17) << state.time << ',' << state.step << ','
        << record.report.step << ',' << record.report.n_iterations << ','
        << record.n_lost_iterations;
    for (const double value : {record.report.max_displacement,
                               record.report.error,
                               a.kinetic,
                               a.strain,
                               a.conditions,
                               a.dissipated,
                               a.external_work,
                               a.balance,
                               a.linear_momentum[0],
                               a.linear_momentum[1],
                               a.angular_momentum})
      out << ',' << value;
    for (const double value : further_values)
      out << ',' << value;
    out << std::endl;
    AssertThrow(out, OutputFailure(filename));
  }
} // namespace NMM
