// The page of a trial of type attention.

import { start } from "./item.js";

start();
