// Frames, angles and the kinematic chain, for Python.
#include <pybind11/stl.h>

#include "geometry/direction.h"
#include "geometry/kinematic_chain.h"
#include "geometry/lens.h"
#include "geometry/sight.h"
#include "geometry/wgs84.h"
#include "tools/python/bindings.h"
#include "tools/python/eigen_caster.h"

namespace ols::python {
namespace {

using py::arg;

void bind_wgs84(py::module_& m) {
  data_class<Geodetic>(m, "Geodetic", "WGS84 position; radians, ellipsoidal height in metres.")
      .def_readwrite("latitude_rad", &Geodetic::latitude_rad)
      .def_readwrite("longitude_rad", &Geodetic::longitude_rad)
      .def_readwrite("height_m", &Geodetic::height_m);

  m.def("ecef_from_geodetic", &ecef_from_geodetic, arg("position"),
        "Geodetic -> (3,) ECEF position in metres.");
  m.def("geodetic_from_ecef", &geodetic_from_ecef, arg("p_ecef"),
        "(3,) ECEF position in metres -> Geodetic.");
  m.def("R_ecef_enu", py::overload_cast<const Geodetic&>(&R_ecef_enu), arg("position"),
        "(3, 3) rotation from east-north-up components at a Geodetic to ECEF components.");
  m.def("R_ecef_enu", py::overload_cast<const Eigen::Vector3d&>(&R_ecef_enu), arg("p_ecef"),
        "(3, 3) rotation from east-north-up components at a (3,) ECEF position [m] to ECEF.");

  py::class_<LocalFrame>(m, "LocalFrame", "East-north-up frame with its origin at a Geodetic.")
      .def(py::init<const Geodetic&>(), arg("origin"))
      .def("to_enu", &LocalFrame::to_enu, arg("p_ecef"),
           "(3,) ECEF position [m] -> (3,) east, north, up [m].")
      .def("to_ecef", &LocalFrame::to_ecef, arg("p_enu"),
           "(3,) east, north, up [m] -> (3,) ECEF position [m].")
      .def_property_readonly(
          "R_ecef_enu", [](const LocalFrame& frame) { return Eigen::Matrix3d(frame.R_ecef_enu()); },
          "(3, 3) rotation from east-north-up to ECEF components.")
      .def_property_readonly(
          "origin_ecef",
          [](const LocalFrame& frame) { return Eigen::Vector3d(frame.origin_ecef()); },
          "(3,) ECEF position of the origin [m].")
      .def_property_readonly("origin", [](const LocalFrame& frame) { return frame.origin(); })
      .def("__reduce__", [](const py::object& frame) {
        return py::make_tuple(py::type::of(frame), py::make_tuple(frame.attr("origin")));
      });
}

void bind_direction(py::module_& m) {
  data_class<AzimuthElevation>(m, "AzimuthElevation",
                               "Direction in a horizon: azimuth clockwise from true north "
                               "(0..2 pi), elevation above the horizontal; radians.")
      .def_readwrite("azimuth_rad", &AzimuthElevation::azimuth_rad)
      .def_readwrite("elevation_rad", &AzimuthElevation::elevation_rad);

  m.def("enu_from_azimuth_elevation", &enu_from_azimuth_elevation, arg("direction"),
        "AzimuthElevation -> (3,) unit vector, east-north-up.");
  m.def("azimuth_elevation_from_enu", &azimuth_elevation_from_enu, arg("v_enu"),
        "(3,) non-zero vector, east-north-up -> AzimuthElevation; at the zenith azimuth is 0.");
  m.def("tangent_basis", &tangent_basis, arg("direction"),
        "(3, 2): unit vectors, east-north-up, of growing cross-elevation and elevation.");
  m.def("angle_between", &angle_between, arg("a"), arg("b"),
        "Angle between two (3,) vectors [rad], exact also when it is tiny.");

  data_class<LineOfSight>(m, "SightLine", "A measured line of sight.")
      .def_readwrite("origin_ecef", &LineOfSight::origin_ecef, "(3,) camera centre, ECEF [m].")
      .def_readwrite("direction", &LineOfSight::direction,
                     "AzimuthElevation in the horizon at origin_ecef.")
      .def_readwrite("covariance_white", &LineOfSight::covariance_white,
                     "(2, 2) [rad^2], (cross-elevation, elevation): new with every frame.")
      .def_readwrite("covariance_systematic", &LineOfSight::covariance_systematic,
                     "(2, 2) [rad^2], (cross-elevation, elevation): stays.")
      .def_readwrite(
          "aim_sd_rad", &LineOfSight::aim_sd_rad,
          "1-sigma of the followed point against the target's middle, of each axis; part "
          "of covariance_systematic.")
      .def_readwrite("origin_sd_enu_m", &LineOfSight::origin_sd_enu_m,
                     "(3,) east, north, up [m]: 1-sigma of the origin, stays.");
  m.def("direction_ecef", &direction_ecef, arg("sight"),
        "LineOfSight -> (3,) unit vector in ECEF components.");
}

void bind_pinhole(py::module_& m) {
  py::enum_<LensModel>(m, "LensModel", "How a lens images directions (geometry/lens.h).")
      .value("PINHOLE", LensModel::kPinhole)
      .value("FISHEYE", LensModel::kFisheye)
      .value("POLYNOMIAL", LensModel::kPolynomial);
  data_class<CameraIntrinsics>(m, "CameraIntrinsics",
                               "A camera: a pinhole with OpenCV's distortion (k1, k2, p1, p2, k3), "
                               "or a fisheye or polynomial "
                               "(k1 to k4); pixel (0, 0) is the centre of the top-left pixel.")
      .def_readwrite("width_px", &CameraIntrinsics::width_px)
      .def_readwrite("height_px", &CameraIntrinsics::height_px)
      .def_readwrite("fx_px", &CameraIntrinsics::fx_px)
      .def_readwrite("fy_px", &CameraIntrinsics::fy_px)
      .def_readwrite("cx_px", &CameraIntrinsics::cx_px)
      .def_readwrite("cy_px", &CameraIntrinsics::cy_px)
      .def_readwrite("skew", &CameraIntrinsics::skew, "K(0, 1) [px]")
      .def_readwrite("model", &CameraIntrinsics::model)
      .def_readwrite("k1", &CameraIntrinsics::k1)
      .def_readwrite("k2", &CameraIntrinsics::k2)
      .def_readwrite("p1", &CameraIntrinsics::p1)
      .def_readwrite("p2", &CameraIntrinsics::p2)
      .def_readwrite("k3", &CameraIntrinsics::k3)
      .def_readwrite("k4", &CameraIntrinsics::k4);

  m.def("camera_matrix", &camera_matrix, arg("intrinsics"), "(3, 3) K of the paper.");
  m.def("projection_matrix", &projection_matrix, arg("K"), arg("R"), arg("C"),
        "(3, 4) P = K R [I | -C]; R (3, 3) takes world to camera components, C (3,) is the camera "
        "centre in the world [m].");
  m.def("back_project", &back_project, arg("P"), arg("pixel"),
        "(3, 4) P, (2,) pixel -> (3,) unit direction in the world, to the front of the camera.");
  m.def("project", &project, arg("intrinsics"), arg("p_cam"),
        "(3,) point in the camera frame (x right, y down, z forward) [m] -> (2,) pixel; None when "
        "behind the camera or beyond the fold of the distortion model.");
  m.def("unproject", &unproject, arg("intrinsics"), arg("pixel"),
        "(2,) pixel -> (3,) unit direction in the camera frame; None outside the valid field.");
  m.def("project_jacobian", &project_jacobian, arg("intrinsics"), arg("p_cam"),
        "(2, 3) derivative of project() by the point [px/m].");
  m.def("field_of_view", &field_of_view, arg("intrinsics"),
        "(2,) whole angle of view, horizontal and vertical [rad], without distortion.");
}

void bind_chain_types(py::module_& m) {
  py::enum_<Joint>(m, "Joint", "The joints of the kinematic chain (paper, Figure 2).")
      .value("GROUND", Joint::kGround)
      .value("ORIGIN", Joint::kOrigin)
      .value("AZI", Joint::kAzi)
      .value("ELE", Joint::kEle)
      .value("FOCUS", Joint::kFocus)
      .value("CAMERA", Joint::kCamera);

  data_class<PanTilt>(m, "PanTilt", "Pan and tilt as the PTU reports them [rad].")
      .def_readwrite("pan_rad", &PanTilt::pan_rad)
      .def_readwrite("tilt_rad", &PanTilt::tilt_rad);

  data_class<Link>(m, "Link", "One link of eq. (1): translation, then RZ, RX, RY.")
      .def_readwrite("translation_m", &Link::translation_m, "(3,) in the previous joint's frame.")
      .def_readwrite("rz_rad", &Link::rz_rad)
      .def_readwrite("rx_rad", &Link::rx_rad)
      .def_readwrite("ry_rad", &Link::ry_rad);

  using Chain = ChainParameters;
  data_class<Chain>(m, "ChainParameters",
                    "A station's geometry; frames are X forward, Y left, Z up.")
      .def_readwrite("heading_rad", &Chain::heading_rad,
                     "Of the zero pan direction, clockwise from true north.")
      .def_readwrite("tilt_x_rad", &Chain::tilt_x_rad, "Of ORIGIN about X, right side down > 0.")
      .def_readwrite("tilt_y_rad", &Chain::tilt_y_rad, "Of ORIGIN about Y, nose down > 0.")
      .def_readwrite("ground_to_origin_m", &Chain::ground_to_origin_m, "(3,) east, north, up.")
      .def_readwrite("origin_to_azi_m", &Chain::origin_to_azi_m)
      .def_readwrite("azi_to_ele_m", &Chain::azi_to_ele_m)
      .def_readwrite("ele_to_focus_m", &Chain::ele_to_focus_m)
      .def_readwrite("focus_to_camera_m", &Chain::focus_to_camera_m)
      .def_readwrite("mount_z_rad", &Chain::mount_z_rad)
      .def_readwrite("mount_x_rad", &Chain::mount_x_rad)
      .def_readwrite("mount_y_rad", &Chain::mount_y_rad)
      .def_readwrite("trunnion_rad", &Chain::trunnion_rad)
      .def_readwrite("pan_sign", &Chain::pan_sign, "shaft = sign * reported + zero; left > 0.")
      .def_readwrite("tilt_sign", &Chain::tilt_sign, "shaft = sign * reported + zero; up > 0.")
      .def_readwrite("pan_zero_rad", &Chain::pan_zero_rad)
      .def_readwrite("tilt_zero_rad", &Chain::tilt_zero_rad);
}

// Poses reach Python as plain 4x4 matrices.
void bind_chain_functions(py::module_& m) {
  m.def(
      "next_joint",
      [](const Eigen::Matrix4d& M_previous, const Link& link) {
        return next_joint(Eigen::Isometry3d(M_previous), link).matrix();
      },
      arg("M_previous"), arg("link"), "(4, 4) M_next = M_previous T RZ RX RY, eq. (1).");
  m.def("links", &links, arg("chain"), arg("angles"), "The five links, ORIGIN..CAMERA.");
  m.def(
      "joints",
      [](const ChainParameters& chain, const PanTilt& angles) {
        py::dict poses;
        int joint = 0;
        for (const Eigen::Isometry3d& pose : joints(chain, angles)) {
          poses[py::cast(static_cast<Joint>(joint++))] = Eigen::Matrix4d(pose.matrix());
        }
        return poses;
      },
      arg("chain"), arg("angles"),
      "{Joint: (4, 4) pose of the joint in GROUND, east-north-up [m]}.");
  m.def(
      "enu_from_camera",
      [](const ChainParameters& chain, const PanTilt& angles) {
        return Eigen::Matrix4d(enu_from_camera(chain, angles).matrix());
      },
      arg("chain"), arg("angles"),
      "(4, 4) pose of the camera (x right, y down, z forward) in GROUND, east-north-up [m].");
  m.def("aim", &aim, arg("chain"), arg("direction_enu"),
        arg("direction_cam") = Eigen::Vector3d(Eigen::Vector3d::UnitZ()),
        "PanTilt that brings a (3,) direction of the camera frame onto a (3,) direction in GROUND; "
        "None where no pan and tilt does.");
}

void bind_sight_types(py::module_& m) {
  data_class<CalibrationSd>(m, "CalibrationSd", "What is not known of a calibration, 1-sigma.")
      .def_readwrite("heading_rad", &CalibrationSd::heading_rad)
      .def_readwrite("tilt_rad", &CalibrationSd::tilt_rad, "Of each axis of ORIGIN.")
      .def_readwrite("mount_rad", &CalibrationSd::mount_rad, "About each axis across the optical.")
      .def_readwrite("mount_roll_rad", &CalibrationSd::mount_roll_rad, "About the optical axis.")
      .def_readwrite("position_m", &CalibrationSd::position_m, "Of each of east, north, up.");

  data_class<StationGeometry>(m, "StationGeometry", "A station's calibrated geometry.")
      .def_readwrite("position", &StationGeometry::position, "Geodetic of GROUND.")
      .def_readwrite("chain", &StationGeometry::chain)
      .def_readwrite("camera", &StationGeometry::camera)
      .def_readwrite("sd", &StationGeometry::sd);

  data_class<PixelSight>(m, "PixelSight", "A measured pixel and the PTU angles at its exposure.")
      .def_readwrite("pixel", &PixelSight::pixel, "(2,) x right, y down.")
      .def_readwrite("covariance_px2", &PixelSight::covariance_px2, "(2, 2) white.")
      .def_readwrite("covariance_systematic_px2", &PixelSight::covariance_systematic_px2,
                     "(2, 2) stays.")
      .def_readwrite("angles", &PixelSight::angles)
      .def_readwrite("angles_covariance_rad2", &PixelSight::angles_covariance_rad2,
                     "(2, 2) white, (pan, tilt).")
      .def_readwrite("angles_systematic_rad2", &PixelSight::angles_systematic_rad2,
                     "(2, 2) stays, (pan, tilt).");

  data_class<View>(m, "View", "A point seen by a station.")
      .def_readwrite("pixel", &View::pixel, "(2,)")
      .def_readwrite("distance_m", &View::distance_m, "From the camera centre.");
}

void bind_sight_functions(py::module_& m) {
  m.def("sight", &sight, arg("station"), arg("measurement"),
        "StationGeometry, PixelSight -> LineOfSight with first-order covariances; None when the "
        "pixel "
        "cannot be unprojected.");
  m.def("view", &view, arg("station"), arg("angles"), arg("p_ecef"),
        "View of a (3,) ECEF position [m] at given PTU angles; None when it is not in front.");
  m.def(
      "aim_at", &aim_at, arg("station"), arg("p_ecef"), arg("pixel") = py::none(),
      "PanTilt that puts a (3,) ECEF position [m] on a (2,) pixel (default: on the optical axis); "
      "None when out of reach.");
  m.def(
      "aim_along", &aim_along, arg("station"), arg("direction"),
      "PanTilt that brings the optical axis onto an AzimuthElevation in the horizon at the camera "
      "centre; None when out of reach.");
  m.def("optical_axis", &optical_axis, arg("station"), arg("angles"),
        "AzimuthElevation of the optical axis in the horizon at the camera centre.");
  m.def("camera_centre_ecef", &camera_centre_ecef, arg("station"), arg("angles"),
        "(3,) camera centre, ECEF [m].");
  // `from` is a keyword of Python.
  m.def("rotation_homography", &rotation_homography, arg("station"), arg("from_angles"),
        arg("to_angles"),
        "(3, 3) homography of pixels at one pair of PTU angles to those at another, for points at "
        "infinity, without distortion.");
}

}  // namespace

void bind_geometry(py::module_& m) {
  bind_wgs84(m);
  bind_direction(m);
  bind_pinhole(m);
  bind_chain_types(m);
  bind_chain_functions(m);
  bind_sight_types(m);
  bind_sight_functions(m);
}

}  // namespace ols::python
