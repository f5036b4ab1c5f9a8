/* Runs before the first paint: says that script is there, so that ten pictures can wait for one another. */
(function () {
  if ("noModule" in HTMLScriptElement.prototype && "decode" in HTMLImageElement.prototype && window.fetch && window.indexedDB && window.HTMLDialogElement) {
    document.documentElement.className += " js";
  }
})();
