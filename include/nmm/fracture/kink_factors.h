#ifndef nmm_fracture_kink_factors_h
#define nmm_fracture_kink_factors_h

namespace NMM
{
  /**
   * Intensity factors K' at the tip of a kink of vanishing length that leaves a crack of
   * intensity factors K under the angle phi,
   * @f[ K_I' = F_{11}K_I + F_{12}K_{II}, \qquad K_{II}' = F_{21}K_I + F_{22}K_{II}. @f]
   */
  struct KinkFactors
  {
    double F_11, F_12, F_21, F_22;
  };

  /**
   * The series in m = phi / pi of M. Amestoy, J.-B. Leblond, Int. J. Solids Struct. 29
   * (1992), 465-501, up to m^20. @p angle in [-pi/2, pi/2] [rad]; there it is good to 1e-4.
   */
  KinkFactors
  kink_factors(double angle);
} // namespace NMM

#endif
