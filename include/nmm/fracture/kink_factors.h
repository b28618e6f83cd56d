#ifndef nmm_fracture_kink_factors_h
#define nmm_fracture_kink_factors_h

namespace NMM
{
  /**
   * The factors F that give the intensity factors K' at the tip of a kink of vanishing length,
   * which leaves a crack with intensity factors K at the angle phi,
   * @f[ K_I' = F_{11}K_I + F_{12}K_{II}, \qquad K_{II}' = F_{21}K_I + F_{22}K_{II}. @f]
   */
  struct KinkFactors
  {
    /// Factor on K_I in K_I' [-].
    double F_11;
    /// Factor on K_II in K_I' [-].
    double F_12;
    /// Factor on K_I in K_II' [-].
    double F_21;
    /// Factor on K_II in K_II' [-].
    double F_22;
  };

  /**
   * The kink factors at @p angle [rad], from the series in m = phi / pi up to m^20 by M. Amestoy,
   * J.-B. Leblond, Int. J. Solids Struct. 29 (1992), 465-501. For angles in [-pi/2, pi/2] its
   * error is about 1e-4.
   */
  KinkFactors
  kink_factors(double angle);
} // namespace NMM

#endif
