#ifndef step_nmm_2_cantilever_h
#define step_nmm_2_cantilever_h

// The parameters of step-nmm-2, and what others have computed.

#include "tutorial/table.h"
#include "tutorial/tutorial.h"
#include <cmath>
#include <map>
#include <string>
#include <vector>

namespace StepNMM2
{
  enum class Load
  {
    /// Keeps its direction.
    dead,
    /// Pressure on top, suction below.
    follower
  };

  constexpr Load loads[] = {Load::dead, Load::follower};

  std::string
  name(Load load);


  struct Parameters : Tutorial::ParameterFile
  {
    using ParameterFile::ParameterFile;

    /// [m], [m], [Pa], [-]
    double length = 10., height = 1.;
    double youngs_modulus = 120000., poissons_ratio = 0.2;
    /// K = P L^3 / (E I) at the end.
    double last_load = 10.;

    /// Edge lengths of the triangles far from the clamped corners [m].
    std::vector<double> cell_sizes =
      get<std::vector<double>>("Cell sizes",
                               {0.6, 0.33, 0.22, 0.139, 0.09},
                               positive_list);
    /// Edge length at the corners over the one far away, and its growth per
    /// distance.
    double corner_ratio  = get("Corner ratio", 0.3, part);
    double corner_growth = get("Corner growth", 0.3, part);
    /// Where the mesh lies against the beam.
    Tutorial::Placement placement = {get("Offset",
                                         dealii::Tensor<1, 2>({0.03, 0.02})),
                                     get("Rotation", 7.)};

    /// Equal steps of Newton's method up to the last load.
    unsigned int n_load_steps =
      get("Load steps", 5u, dealii::Patterns::Integer(1, 1000));
    /// Numbers of steps of the paper's scheme.
    std::vector<unsigned int> increments =
      get<std::vector<unsigned int>>("Increments",
                                     {10, 20, 50, 100, 200, 500, 1000},
                                     dealii::Patterns::List(
                                       dealii::Patterns::Integer(1)));
    /// Cell size of the runs by increments, the random placements and the figures
    /// [m].
    double       cell_size = get("Cell size", 0.33, positive);
    unsigned int n_placements =
      get("Placements", 5u, dealii::Patterns::Integer(0));
    unsigned int seed = get("Seed", 1u, dealii::Patterns::Integer(0));

    /// P [Pa m / m] at load factor 1.
    double
    force() const;

  private:
    static inline const dealii::Patterns::Double part{1e-3, 1.};
  };


  /// The rows of cantilever.csv for a load: -v / L (w) and -u / L (u) of the point (L, H/2) by K, of Euler's elastica,
  /// Reissner's beam and the solid ("" where not given).
  std::vector<Tutorial::Record>
  reference(Load load);

  /// Largest error of the deflections -v / L by K, relative to the solid's [-].
  double
  largest_error(Load load, const std::map<double, double> &deflections);
} // namespace StepNMM2

#endif
