#include <nmm/covers/element_support.h>
#include <nmm/covers/point_location.h>

#include <Eigen/Eigenvalues>
#include <cmath>

namespace NMM
{
  using namespace dealii;

  namespace
  {
    /// Moments of a polygon about the centroid of the reference triangle.
    class Moments
    {
    public:
      /// Add the part between the centroid and the edge a -> b.
      void
      add(const Tensor<1, 2> &a, const Tensor<1, 2> &b)
      {
        // Area of the triangle (0, a, b), and its exact moments.
        const double area = 0.5 * (a[0] * b[1] - a[1] * b[0]);
        m += area;
        first += area / 3. * (a + b);
        for (unsigned int i = 0; i < 2; ++i)
          for (unsigned int j = i; j < 2; ++j)
            second(i, j) +=
              area / 12. *
              (2. * a[i] * a[j] + 2. * b[i] * b[j] + a[i] * b[j] + a[j] * b[i]);
      }

      /// Matrix of moments in the orthonormal basis 1, sqrt(18) x, sqrt(24) (y + x / 2) of the
      /// reference triangle, divided by its area.
      Eigen::Matrix3d
      normalized() const
      {
        const double    sx = std::sqrt(18.), sy = std::sqrt(24.);
        const double    xx = second(0, 0), xy = second(0, 1), yy = second(1, 1);
        Eigen::Matrix3d result;
        result(0, 0) = m;
        result(0, 1) = sx * first[0];
        result(0, 2) = sy * (first[1] + 0.5 * first[0]);
        result(1, 1) = sx * sx * xx;
        result(1, 2) = sx * sy * (xy + 0.5 * xx);
        result(2, 2) = sy * sy * (yy + xy + 0.25 * xx);
        return 2. * Eigen::Matrix3d(result.selfadjointView<Eigen::Upper>());
      }

    private:
      double          m = 0.;
      Tensor<1, 2>    first;
      Eigen::Matrix2d second = Eigen::Matrix2d::Zero();
    };
  } // namespace


  namespace
  {
    /// The matrix whose smallest eigenvalue is the support of a cut element.
    Eigen::Matrix3d
    normalized_moments(const ManifoldMesh &manifold_mesh,
                       const unsigned int  element)
    {
      const MathematicalMesh &mesh = manifold_mesh.mathematical_mesh();
      const unsigned int      cell = manifold_mesh.cell(element);
      const Point<2>          centroid(1. / 3., 1. / 3.);
      const Point<2>    &origin = mesh.vertices()[mesh.cell_vertices(cell)[0]];
      const Tensor<2, 2> to_reference  = invert(mesh.jacobian(cell));
      const auto         from_centroid = [&](const Point<2> &x) {
        return Tensor<1, 2>(Point<2>(to_reference * (x - origin)) - centroid);
      };

      Moments moments;
      for (const ElementEdge &edge : manifold_mesh.edges(element))
      {
        Tensor<1, 2> a = from_centroid(edge.start);
        if (edge.is_arc())
        {
          constexpr unsigned int n_chords = 8;
          const double           radius   = std::abs(edge.radius);
          const double           from  = angle_about(edge.center, edge.start);
          const double           sweep = swept_angle(edge);
          for (unsigned int i = 1; i < n_chords; ++i)
          {
            const double       t = from + sweep * i / n_chords;
            const Tensor<1, 2> b = from_centroid(
              edge.center + radius * Tensor<1, 2>({std::cos(t), std::sin(t)}));
            moments.add(a, b);
            a = b;
          }
        }
        moments.add(a, from_centroid(edge.end));
      }
      return moments.normalized();
    }


    double
    smallest_eigenvalue(const Eigen::Matrix3d &matrix)
    {
      const double smallest =
        Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(matrix,
                                                       Eigen::EigenvaluesOnly)
          .eigenvalues()(0);
      return std::max(smallest, 0.);
    }


    /// Whether all eigenvalues are above @p bound, by Sylvester's criterion: 1 if they are, -1 if
    /// not, 0 if rounding may decide.
    int
    compare_eigenvalues(const Eigen::Matrix3d &matrix, const double bound)
    {
      constexpr double margin = 1e-12;
      const double a = matrix(0, 0) - bound, b = matrix(0, 1), c = matrix(0, 2),
                   d = matrix(1, 1) - bound, e = matrix(1, 2),
                   f = matrix(2, 2) - bound;
      for (const double minor :
           {a,
            a * d - b * b,
            a * (d * f - e * e) - b * (b * f - c * e) + c * (b * e - c * d)})
        if (minor < margin)
          return minor > -margin ? 0 : -1;
      return 1;
    }
  } // namespace


  double
  element_support(const ManifoldMesh &manifold_mesh, const unsigned int element)
  {
    return manifold_mesh.is_whole(element)
             ? 1.
             : smallest_eigenvalue(normalized_moments(manifold_mesh, element));
  }


  bool
  has_support(const ManifoldMesh &manifold_mesh,
              const unsigned int  element,
              const double        threshold)
  {
    if (manifold_mesh.is_whole(element))
      return 1. >= threshold;
    const Eigen::Matrix3d matrix = normalized_moments(manifold_mesh, element);
    const int             sign   = compare_eigenvalues(matrix, threshold);
    return sign == 0 ? smallest_eigenvalue(matrix) >= threshold : sign > 0;
  }
} // namespace NMM
