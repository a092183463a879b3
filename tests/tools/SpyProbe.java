// Starts the real lcm-spy, reads its table, double-clicks a channel and clicks a sparkline and reports what a person would see.
// usage: SpyProbe CHANNEL SECONDS PICTURE.png
import java.awt.*;
import java.awt.event.MouseEvent;
import java.awt.image.BufferedImage;
import java.io.File;
import java.util.*;
import java.util.List;
import javax.imageio.ImageIO;
import javax.swing.*;

public class SpyProbe {
  // Where lcm-spy draws the sparkline of the second field (cycle) of a message.
  static final int SPARKLINE_X = 580, SPARKLINE_Y = 44;

  static <T> List<T> find(Container root, Class<T> kind) {
    List<T> found = new ArrayList<>();
    for (Component child : root.getComponents()) {
      if (kind.isInstance(child)) found.add(kind.cast(child));
      if (child instanceof Container) found.addAll(find((Container) child, kind));
    }
    return found;
  }

  static <T> List<T> onScreen(Class<T> kind) {
    List<T> found = new ArrayList<>();
    for (Window window : Window.getWindows()) found.addAll(find(window, kind));
    return found;
  }

  static void click(Component target, int x, int y, int count) {
    for (int id : new int[] {MouseEvent.MOUSE_MOVED, MouseEvent.MOUSE_PRESSED, MouseEvent.MOUSE_RELEASED, MouseEvent.MOUSE_CLICKED})
      target.dispatchEvent(new MouseEvent(target, id, System.currentTimeMillis(), 0, x, y, id == MouseEvent.MOUSE_MOVED ? 0 : count,
                                          false, id == MouseEvent.MOUSE_MOVED ? MouseEvent.NOBUTTON : MouseEvent.BUTTON1));
  }

  static void reportFrames() {
    for (Frame frame : Frame.getFrames())
      if (frame.isShowing()) System.out.println("frame\t" + frame.getTitle() + "\t" + inkOf((JFrame) frame));
  }

  /** Dark pixels: text and curves. */
  static int inkOf(JFrame frame) {
    BufferedImage image = new BufferedImage(frame.getWidth(), frame.getHeight(), BufferedImage.TYPE_INT_RGB);
    frame.getContentPane().paint(image.getGraphics());
    int ink = 0;
    for (int y = 0; y < image.getHeight(); ++y)
      for (int x = 0; x < image.getWidth(); ++x)
        if (new Color(image.getRGB(x, y)).getGreen() < 90) ++ink;
    return ink;
  }

  public static void main(String[] args) throws Exception {
    lcm.spy.Spy.main(new String[0]);
    Thread.sleep(1000L * Integer.parseInt(args[1]));
    SwingUtilities.invokeAndWait(() -> {
      JTable table = onScreen(JTable.class).get(0);
      for (int row = 0; row < table.getRowCount(); ++row) {
        StringJoiner line = new StringJoiner("\t", "row\t", "");
        for (int column = 0; column < table.getColumnCount(); ++column) line.add(String.valueOf(table.getValueAt(row, column)));
        System.out.println(line);
      }
      for (int row = 0; row < table.getRowCount(); ++row)
        if (args[0].equals(table.getValueAt(row, 0))) {
          Rectangle cell = table.getCellRect(row, 0, true);
          click(table, cell.x + 5, cell.y + 5, 2);
        }
    });
    Thread.sleep(2000);
    SwingUtilities.invokeAndWait(SpyProbe::reportFrames);
    SwingUtilities.invokeAndWait(() -> click(onScreen(lcm.spy.ObjectPanel.class).get(0), SPARKLINE_X, SPARKLINE_Y, 1));
    Thread.sleep(2000);
    SwingUtilities.invokeAndWait(SpyProbe::reportFrames);
    Rectangle screen = new Rectangle(Toolkit.getDefaultToolkit().getScreenSize());
    ImageIO.write(new Robot().createScreenCapture(screen), "png", new File(args[2]));
    System.exit(0);
  }
}
