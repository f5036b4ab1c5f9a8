// The page of a trial of type categorise.

import { start } from "./item.js";

start();
