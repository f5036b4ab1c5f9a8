// The editor of heads of identity modes.

import { edit } from "./head-editor.js";

const draw = edit();
draw();
