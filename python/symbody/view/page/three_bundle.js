// What the viewer uses of three.js (MIT licence, LICENSE.three), in one script without imports: `three.min.js`.
// Made once, in a folder where `npm install three@0.187.0 esbuild@0.28.2` has run:
//   npx esbuild three_bundle.js --bundle --minify --format=iife --global-name=THREE --legal-comments=inline \
//     --outfile=three.min.js
export {
  AmbientLight, ArrowHelper, BoxGeometry, BufferAttribute, BufferGeometry, Color, CylinderGeometry, DirectionalLight,
  EdgesGeometry, ExtrudeGeometry, GridHelper, Group, HemisphereLight, Line, LineBasicMaterial, LineSegments, Mesh,
  MeshStandardMaterial, PerspectiveCamera, Quaternion, Scene, Shape, SphereGeometry, Vector2, Vector3, WebGLRenderer,
} from "three";
export { OrbitControls } from "three/examples/jsm/controls/OrbitControls.js";
