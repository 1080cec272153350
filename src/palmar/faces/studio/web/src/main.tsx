/** Where the page begins. */

import { createRoot } from "react-dom/client";
import { App } from "./shell/app";
import "./style/palette.css";
import "./style/page.css";
import "./style/workbench.css";
import "./style/controls.css";
import "./style/answers.css";
import "./style/drawing.css";
import "./style/overlays.css";
import "./style/design.css";

createRoot(document.getElementById("studio") as HTMLElement).render(<App />);
