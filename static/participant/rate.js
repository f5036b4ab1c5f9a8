// The page of a trial of type rate.

import { start } from "./item.js";

start();
