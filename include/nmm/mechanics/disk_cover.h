#ifndef nmm_mechanics_disk_cover_h
#define nmm_mechanics_disk_cover_h

#include <deal.II/base/point.h>
#include <deal.II/base/symmetric_tensor.h>
#include <deal.II/base/tensor.h>

#include <functional>
#include <vector>

namespace NMM
{
  /**
   * A physical cover that is a disk, with functions F_j of its own. They are added to the
   * displacement of the other covers,
   * @f[ u = \sum_i w_i u_i + \begin{cases}\sum_j c_j F_j & \text{in the disk}\\ 0 &
       \text{elsewhere.}\end{cases} @f]
   * The circle is an interface of the physical mesh, so that the covers on its two
   * sides are independent. Nitsche's method ties the whole displacements of the two sides,
   * as it ties all interfaces. Hence the functions need not vanish on the circle, no cell
   * blends them with something else, and the stiffness matrix of the other covers remains as it is.
   *
   * The functions are elastic fields without body force and initial stress. On curves within the
   * disk they have no traction. Thus for all v, with the outward normal n of the circle,
   * @f[ \int_\mathrm{disk} \sigma(F_j):\varepsilon(v)\,dA
       = \oint \sigma(F_j)n\cdot v\,ds, @f]
   * and all terms of the equations are integrals of smooth functions on the circle, also if the
   * functions are singular within it.
   *
   * Source of the idea: E. Chahine, P. Laborde, Y. Renard, Appl. Numer. Math. 61 (2011), 322-343,
   * "A non-conformal extended finite element approach: integral matching Xfem".
   */
  class DiskCover
  {
  public:
    /// A function at a point.
    struct Value
    {
      /// Displacement u [m] per unit of the coefficient.
      dealii::Tensor<1, 2> displacement;
      /// Displacement gradient du_i/dx_j [-] per unit of the coefficient.
      dealii::Tensor<2, 2> gradient;
    };

    /// What acts on the solid within the disk.
    struct Loads
    {
      /// Body force [N/m^3] as a function of the point; empty: none.
      std::function<dealii::Tensor<1, 2>(const dealii::Point<2> &)> body_force;
      /// Initial stress [Pa].
      dealii::SymmetricTensor<2, 2> initial_stress;
      /// Pressure on the curve within the disk [Pa], on both of its faces; empty: none.
      std::function<double(const dealii::Point<2> &)> face_pressure;
    };

    virtual ~DiskCover() = default;

    /// Number of functions.
    virtual unsigned int
    n_functions() const = 0;

    /// Whether a point [m] lies in the disk.
    virtual bool
    contains(const dealii::Point<2> &x) const = 0;

    /// Function @p i at a point of the disk [m]. On a curve that the function jumps at, the
    /// value is that of the side to which @p into_solid points; if that is zero, the mean of both.
    virtual Value
    evaluate(unsigned int                i,
             const dealii::Point<2>     &x,
             const dealii::Tensor<1, 2> &into_solid) const = 0;

    /**
     * Work of @p loads on each of the functions [N/m per unit of the coefficient]: that of the body
     * force, of the pressure, and of the initial stress,
     * @f[ -\int_\mathrm{disk}\sigma_0:\varepsilon(F_j)\,dA + \oint\sigma_0n\cdot F_j\,ds
         = -\int_\mathrm{faces}\sigma_0n\cdot F_j\,ds, @f]
     * with the integral over the circle from Nitsche's method.
     */
    virtual std::vector<double>
    work(const Loads &loads) const = 0;
  };
} // namespace NMM

#endif
