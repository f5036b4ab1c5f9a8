/* Runs before the first paint: says that script is there, so that ten pictures can wait for one another; that a browser
   is too old; and how large a face has to be. */
(function () {
  var root = document.documentElement;
  var able = "noModule" in HTMLScriptElement.prototype && "decode" in HTMLImageElement.prototype && window.fetch && window.HTMLDialogElement;
  root.className += able ? " js" : " old";
  var height = Number(root.getAttribute("data-tile-height"));
  if (height) root.style.setProperty("--wanted-width", (height * 5) / 6 + "px");
})();
